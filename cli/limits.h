// The limits of one case. Exceeding them is a finding of its own.
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

// Adds the same options to commands that run no case in a process of its own. The limits then apply to the program
// under test.
void add_program_limit_options(CLI::App& command, LimitOptions& options);
void take_limits(const LimitOptions& options, Sources& sources);

}  // namespace contort::cli
