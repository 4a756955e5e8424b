#include "cli/input.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "checks/joint_map.h"
#include "generator/actions/action.h"
#include "generator/motion/aim_tables.h"
#include "generator/recordings.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "formats/detect/file_format.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

constexpr double kLongestTime_s = 1e7;
constexpr char kSpecOrCase[] = "a spec or a case (JSON)";

// Returns true for a glTF model as text, which is JSON too.
bool is_gltf(const json_fields::Json& tree) {
  const auto asset = tree.is_object() ? tree.find("asset") : tree.end();
  return asset != tree.end() && asset->is_object() && asset->contains("version");
}

// An issue with the kind of a file that is neither a spec nor a case.
Issue other_format(const std::string& path, const std::string& text) {
  const std::string expected = "expected \"contort.spec/1\" or \"contort.case/1\"";
  const Result<json_fields::Json> tree = json_fields::parse_document(text);
  if (tree && is_gltf(*tree)) return {"file.wrong_kind", "", path + " is a glTF model, expected " + kSpecOrCase};
  const auto format = tree && tree->is_object() ? tree->find("format") : json_fields::Json::const_iterator();
  const bool is_said = tree && tree->is_object() && format != tree->end() && format->is_string();
  const std::string found = is_said ? "found " + json_fields::quoted(format->get<std::string>()) + ", " : "";
  return {"spec.wrong_format", "/format", path + ": " + found + expected};
}

// An animation file has clips, which another command judges and draws.
Issue with_advice_for_clips(Issue issue, const std::string& path) {
  if (issue.code == "file.wrong_kind" && format_of_file(path) != FileFormat::none)
    issue.text += "; for pictures of clips: contort check " + path + " --report DIR";
  return issue;
}

// The maps that `import` wrote beside its characters. If several folders have one for a name, the first counts.
Result<Done> load_joint_maps(const std::string& folder, Library& into) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder + "/maps", error))
    if (entry.path().extension() == ".json") files.insert(entry.path());
  for (const fs::path& file : files) {
    if (const Result<Done> inside = check_inside(folder, file.string()); !inside) return inside.issue();
    const Result<std::string> text = read_json_file(file.string(), "a map of joints (JSON)");
    if (!text) return text.issue();
    Result<JointMap> map = parse_joint_map(*text);
    if (!map) return about_file(file.string(), map.issue());
    into.joint_maps.try_emplace(file.stem().string(), std::move(map->joints));
  }
  return Done{};
}

}  // namespace

Result<SpecInput> parse_spec_input(const std::string& text, const std::string& path) {
  Result<Spec> spec = parse_spec(text);
  if (spec) return SpecInput{std::move(spec).value(), {}};
  if (spec.issue().code != "spec.wrong_format") return about_file(path, spec.issue());
  Result<Case> stored = parse_case(text);
  if (!stored && stored.issue().code == "case.wrong_format") return other_format(path, text);
  if (!stored) return about_file(path, stored.issue());
  SpecInput input{stored->spec, {}};
  input.stored = std::move(stored).value();
  return input;
}

Result<Library> load_libraries(const std::vector<std::string>& folders) {
  Library library = stock_library();
  for (const std::string& folder : folders) {
    if (const Result<Done> loaded = load_folder(folder, library); !loaded) return loaded.issue();
    if (const Result<Done> loaded = load_recordings(folder, library); !loaded) return loaded.issue();
    if (const Result<Done> loaded = load_joint_maps(folder, library); !loaded) return loaded.issue();
    if (const Result<Done> inside = check_inside(folder, folder + "/aim"); !inside) return inside.issue();
    shared_aim_tables().read_from(folder + "/aim");
  }
  if (const Result<Done> fit = check_actions(library); !fit) return fit.issue();
  return library;
}

Result<CheckSettings> load_settings_file(const std::string& path) {
  if (path.empty()) return CheckSettings{};
  const Result<std::string> text = read_json_file(path, "a settings file (JSON)");
  if (!text) return text.issue();
  Result<CheckSettings> parsed = parse_settings(*text);
  if (!parsed) return about_file(path, parsed.issue());
  return parsed;
}

Result<SpecInput> read_spec_input(const std::string& path, const std::string& level) {
  const Result<std::string> text = read_named_json(path, kSpecOrCase);
  if (!text) return with_advice_for_clips(text.issue(), path);
  Result<SpecInput> input = parse_spec_input(*text, path);
  if (!input || level.empty()) return input;
  const Result<ReplayScope> scope = parse_scope(level);
  if (!scope) return scope.issue();
  SpecInput scoped_input = std::move(input).value();
  scoped_input.spec = scoped(std::move(scoped_input.spec), *scope);
  return scoped_input;
}

void add_level_option(CLI::App& command, std::string& level) {
  command
      .add_option("--level", level,
                  "Use only one sequence, clip or part of the spec: sequence:2, clip:2/1, part:arm_right. A sequence or a "
                  "clip begins from the state that earlier ones leave")
      ->type_name("LEVEL");
}

Result<Case> read_case_input(const std::string& path) {
  const Result<std::string> text = read_named_json(path, "a case (JSON)");
  if (!text) return text.issue();
  Result<Case> stored = parse_case(*text);
  return stored ? stored : about_file(path, stored.issue());
}

const Finding* subject_of(const SpecInput& input, const std::vector<Finding>& findings) {
  if (input.stored) return deepest(findings, input.stored->expect.check, input.stored->expect.subject);
  const Finding* worst = nullptr;
  for (const Finding& finding : findings)
    if (worst == nullptr || finding.depth > worst->depth) worst = &finding;
  return worst;
}

bool plays_another_motion(const SpecInput& input, const Evaluation& evaluation) {
  if (!input.stored || is_abnormal_exit(input.stored->expect)) return false;
  return input.stored->expect.motion_hash != to_hex(evaluation.motion_hash);
}

Result<double> parse_time_s(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string unit(end, text.data() + text.size());
  const double scale = unit.empty() || unit == "s" ? 1.0 : unit == "m" ? 60.0 : unit == "h" ? 3600.0 : 0.0;
  if (error != std::errc{} || !(value > 0.0) || scale == 0.0 || value * scale > kLongestTime_s)
    return Issue{"usage.bad_time", "",
                 "found \"" + text +
                     "\", allowed is a number above 0 with the unit s, m or h, like 45s, 1.5m or 2h, up " +
                     "to 2777h; a number without a unit is in seconds"};
  return value * scale;
}

std::string refuse_nan(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? "found \"" + text + "\", expected a number" : "";
}

std::string shell_quoted(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=+,@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string> Sources::arguments() const {
  std::vector<std::string> out;
  for (const std::string& folder : libraries) out.insert(out.end(), {"--library", folder});
  if (!generator.empty()) out.insert(out.end(), {"--generator", generator});
  return out;
}

std::string replay_command(const std::string& case_path, const Sources& sources) {
  std::string command = "contort replay " + shell_quoted(case_path);
  for (const std::string& argument : sources.arguments()) command += " " + shell_quoted(argument);
  return command;
}

}  // namespace contort::cli
