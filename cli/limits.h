// The most that one case may take before that is a finding of its own.
#pragma once

#include <cstdint>

#include "process/worker_pool.h"

namespace CLI {
class App;
}

namespace contort::cli {

struct LimitOptions {
  double case_timeout_s = 10.0;
  std::int64_t memory_MB = 4096;
  WorkerLimits limits() const { return {case_timeout_s, memory_MB << 20}; }
};

void add_limit_options(CLI::App& command, LimitOptions& options);

}  // namespace contort::cli
