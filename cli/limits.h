// What one case may take before that is a finding of its own.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

#include "corpus/worker_pool.h"

namespace contort::cli {

struct LimitOptions {
  double case_timeout_s = 10.0;
  std::int64_t memory_MB = 4096;
  WorkerLimits limits() const { return {case_timeout_s, memory_MB << 20}; }
};

inline void add_limit_options(CLI::App& command, LimitOptions& options) {
  command
      .add_option("--case-timeout", options.case_timeout_s, "Seconds for one case; a longer one is a finding")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  command
      .add_option("--memory-limit", options.memory_MB, "MB for one worker; a case that needs more is a finding")
      ->check(CLI::Range(64, 1 << 20))
      ->capture_default_str();
}

}  // namespace contort::cli
