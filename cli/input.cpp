#include "cli/input.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "corpus/corpus.h"
#include "generator/core/files.h"
#include "generator/core/hash.h"
#include "generator/core/inside_folder.h"
#include "generator/core/json_fields.h"
#include "generator/motion/aim_tables.h"
#include "generator/recordings.h"

namespace contort::cli {

namespace {

constexpr std::size_t kMaxSpecBytes = 16 << 20;

Issue in_file(const std::string& path, Issue issue) {
  issue.text = path + ": " + issue.text;
  return issue;
}

}  // namespace

Result<Library> load_libraries(const std::vector<std::string>& folders) {
  Library library = stock_library();
  for (const std::string& folder : folders) {
    if (const Result<Done> loaded = load_folder(folder, library); !loaded) return loaded.issue();
    if (const Result<Done> loaded = load_recordings(folder, library); !loaded) return loaded.issue();
    if (const Result<Done> inside = check_inside(folder, folder + "/aim"); !inside) return inside.issue();
    shared_aim_tables().read_from(folder + "/aim");
  }
  if (const Result<Done> fit = check_actions(library); !fit) return fit.issue();
  return library;
}

Result<CheckSettings> load_settings_file(const std::string& path) {
  if (path.empty()) return CheckSettings{};
  const Result<std::string> text = read_regular_file(path, json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  Result<CheckSettings> parsed = parse_settings(*text);
  if (!parsed) return Issue{parsed.issue().code, parsed.issue().pointer, path + ": " + parsed.issue().text};
  return parsed;
}

Result<SpecInput> read_spec_input(const std::string& path) {
  const Result<std::string> text = read_file(path, kMaxSpecBytes);
  if (!text) return text.issue();
  Result<Spec> spec = parse_spec(*text);
  if (spec) return SpecInput{std::move(spec).value(), {}};
  if (spec.issue().code != "spec.wrong_format") return in_file(path, spec.issue());
  Result<Case> stored = parse_case(*text);
  if (!stored && stored.issue().code == "case.wrong_format")
    return in_file(path, {"spec.wrong_format", "/format", "expected \"contort.spec/1\" or \"contort.case/1\""});
  if (!stored) return in_file(path, stored.issue());
  SpecInput input{stored->spec, {}};
  input.stored = std::move(stored).value();
  return input;
}

const Finding* subject_of(const SpecInput& input, const std::vector<Finding>& findings) {
  if (input.stored) return deepest(findings, input.stored->expect.check, input.stored->expect.subject);
  const Finding* worst = nullptr;
  for (const Finding& finding : findings)
    if (worst == nullptr || finding.depth > worst->depth) worst = &finding;
  return worst;
}

bool plays_another_motion(const SpecInput& input, const Evaluation& evaluation) {
  if (!input.stored || is_ending(input.stored->expect)) return false;
  return input.stored->expect.motion_hash != to_hex(evaluation.motion_hash);
}

Result<double> parse_time_s(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string unit(end, text.data() + text.size());
  const double scale = unit.empty() || unit == "s" ? 1.0 : unit == "m" ? 60.0 : unit == "h" ? 3600.0 : 0.0;
  if (error != std::errc{} || !(value > 0.0) || scale == 0.0 || value * scale > 1e7)
    return Issue{"usage.bad_time", "", "found \"" + text + "\", allowed is a number with s, m or h, like 45s or 10m"};
  return value * scale;
}

std::string refuse_nan(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? "found \"" + text + "\", expected a number" : "";
}

Result<std::vector<std::string>> expand_cases(const std::vector<std::string>& paths) {
  std::vector<std::string> cases;
  for (const std::string& path : paths) {
    std::error_code error;
    if (!std::filesystem::is_directory(path, error)) {
      cases.push_back(path);
      continue;
    }
    const Result<Corpus> corpus = Corpus::open(path);
    if (!corpus) return corpus.issue();
    std::vector<Issue> damaged;
    for (const Bucket& bucket : corpus->buckets(damaged))
      for (const std::string& file : {bucket.min, bucket.worst, bucket.orig}) {
        const std::string full = corpus->folder_of(bucket) + "/" + file;
        if (!file.empty()) cases.push_back(full);
      }
    if (!damaged.empty()) return damaged.front();
  }
  return cases;
}

std::string shell_quoted(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=+,@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string replay_command(const std::string& case_path, const std::vector<std::string>& library_folders) {
  std::string command = "contort replay " + shell_quoted(case_path);
  for (const std::string& folder : library_folders) command += " --library " + shell_quoted(folder);
  return command;
}

}  // namespace contort::cli
