// The most that one case may take before that is a finding of its own.
#pragma once

#include <cstdint>

#include "cli/sources.h"
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

// The same for commands that run no case in a process of its own: the limits are those of a program under test.
void add_program_limit_options(CLI::App& command, LimitOptions& options);
void take_limits(const LimitOptions& options, Sources& sources);

}  // namespace contort::cli
