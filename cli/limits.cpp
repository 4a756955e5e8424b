#include "cli/limits.h"

#include <CLI/CLI.hpp>

#include "cli/input.h"

namespace contort::cli {

namespace {

void add_limits(CLI::App& command, LimitOptions& options, const std::string& of_time, const std::string& of_memory) {
  command.add_option("--case-timeout", options.case_timeout_s, of_time)
      ->check(CLI::Range(0.1, 86400.0))
      ->check(refuse_nan)
      ->capture_default_str();
  command.add_option("--memory-limit", options.memory_MB, of_memory)
      ->check(CLI::Range(64, 1 << 20))
      ->capture_default_str();
}

}  // namespace

void add_limit_options(CLI::App& command, LimitOptions& options) {
  add_limits(command, options, "Seconds for one case; a longer one is a finding",
             "MB for one worker; a case that needs more is a finding");
}

void add_program_limit_options(CLI::App& command, LimitOptions& options) {
  add_limits(command, options, "With --generator: seconds for one motion; a longer one is a finding",
             "With --generator: MB for the program; a motion that needs more is a finding");
}

void take_limits(const LimitOptions& options, Sources& sources) {
  sources.case_timeout_s = options.case_timeout_s;
  sources.memory_MB = options.memory_MB;
}

}  // namespace contort::cli
