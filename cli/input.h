// Files that a user names on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checks/settings.h"
#include "corpus/case.h"
#include "generator/character/library.h"
#include "generator/core/result.h"
#include "generator/spec.h"

namespace contort::cli {

// The stock library with everything of these folders.
Result<Library> load_libraries(const std::vector<std::string>& folders);

// Limits and waivers of a file; the defaults for "".
Result<CheckSettings> load_settings_file(const std::string& path);

// A spec, or the spec of a case; told apart by "format".
struct SpecInput {
  Spec spec;
  std::optional<Case> stored;  // when the file is a case
};
Result<SpecInput> read_spec_input(const std::string& path);

// The finding that a picture is about: the one that a case expects; of a spec, the deepest.
const Finding* subject_of(const SpecInput& input, const std::vector<Finding>& findings);

// Whether the generator has changed since the case was stored: what it says is of another motion.
bool plays_another_motion(const SpecInput& input, const Evaluation& evaluation);

// "45s", "10m", "2h", "90" (seconds). Code usage.bad_time.
Result<double> parse_time_s(const std::string& text);

// Why a number on the command line is none, "" where it is one: CLI::Range lets NaN pass.
std::string refuse_nan(const std::string& text);

// Case files named directly, and all cases of the corpus folders named: each bucket's min, worst and orig.
Result<std::vector<std::string>> expand_cases(const std::vector<std::string>& paths);

// How to see a case again, quoted for a shell, with the libraries it needs.
std::string replay_command(const std::string& case_path, const std::vector<std::string>& library_folders);
std::string shell_quoted(const std::string& text);

}  // namespace contort::cli
