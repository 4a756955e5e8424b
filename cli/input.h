// Files that a user names on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checks/settings.h"
#include "cli/sources.h"
#include "corpus/case.h"
#include "corpus/replay_scope.h"
#include "model/character/library.h"
#include "model/core/result.h"
#include "model/spec/spec.h"

namespace CLI {
class App;
}

namespace contort::cli {

// Returns the stock library and all descriptions in these folders.
Result<Library> load_libraries(const std::vector<std::string>& folders);

// Reads limits and waivers; returns the defaults for "".
Result<CheckSettings> load_settings_file(const std::string& path);

// A spec, or the spec of a case, by the file's "format".
struct SpecInput {
  Spec spec;
  std::optional<Case> stored;  // if the file is a case
};
Result<SpecInput> parse_spec_input(const std::string& text, const std::string& path);  // `path` is for messages

// Read a file that is named on the command line; it may be a pipe: <(command), /dev/stdin. `level` is a scope of its
// spec (corpus/replay_scope.h); "": the whole.
Result<SpecInput> read_spec_input(const std::string& path, const std::string& level = "");
Result<Case> read_case_input(const std::string& path);

// Returns the finding that a picture shows: the one that a case expects, or the deepest of a spec.
const Finding* subject_of(const SpecInput& input, const std::vector<Finding>& findings);

// Returns true if the generator has changed since the case was stored, so that its stored values belong to another
// motion.
bool plays_another_motion(const SpecInput& input, const Evaluation& evaluation);

// Declares --level, which takes a sequence, a clip or a part of a spec or case.
void add_level_option(CLI::App& command, std::string& level);

// Parses "45s", "1.5m", "2h", and "90", which is in seconds. Code usage.bad_time.
Result<double> parse_time_s(const std::string& text);

// Returns an error text for NaN, and "" for other numbers, because CLI::Range accepts NaN.
std::string refuse_nan(const std::string& text);

// The command that shows a case again, quoted for a shell, with the libraries and the generator that it needs.
std::string replay_command(const std::string& case_path, const Sources& sources);
std::string shell_quoted(const std::string& text);

}  // namespace contort::cli
