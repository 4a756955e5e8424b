#include "cli/limits.h"

#include <CLI/CLI.hpp>

#include "cli/input.h"

namespace contort::cli {

void add_limit_options(CLI::App& command, LimitOptions& options) {
  command.add_option("--case-timeout", options.case_timeout_s, "Seconds for one case; a longer one is a finding")
      ->check(CLI::Range(0.1, 86400.0))
      ->check(refuse_nan)
      ->capture_default_str();
  command.add_option("--memory-limit", options.memory_MB, "MB for one worker; a case that needs more is a finding")
      ->check(CLI::Range(64, 1 << 20))
      ->capture_default_str();
}

}  // namespace contort::cli
