#include "cli/clips_page.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "cli/input.h"
#include "cli/print.h"
#include "cli/worst_moment.h"
#include "model/core/files.h"
#include "model/core/own_folder.h"
#include "renders/clips_html.h"

namespace contort::cli {

namespace {

constexpr std::string_view kOwnTitle = "<title>Contort check</title>";
constexpr std::size_t kBeginning = 4096;  // bytes at the beginning of a page, which contain its title

// An absolute path, so that a command with it works in every folder.
std::string whole_path(const std::string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return error ? path : whole.lexically_normal().string();
}

// The command up to its files, with the options that affect the findings.
std::string command_of(const ClipCheckOptions& options, const Context& context, const std::vector<std::string>& files) {
  std::vector<std::string> words = {"contort"};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  for (const std::string& word : context.sources.arguments()) words.push_back(word);
  add("--settings", context.settings_file);
  words.emplace_back("check");
  for (const std::string& file : files) words.push_back(whole_path(file));
  add("--character", options.character);
  add("--map", options.map);
  add("--skeleton", options.animation.skeleton);
  add("--unit", options.animation.unit);
  add("--up", options.animation.up);
  if (options.rate_hz) add("--rate-hz", decimal(*options.rate_hz, 6));
  if (options.max_gap_m) add("--max-gap-m", decimal(*options.max_gap_m, 6));
  if (options.max_speed_deg_s != ClipCheckOptions{}.max_speed_deg_s)
    add("--max-speed-deg-s", decimal(options.max_speed_deg_s, 6));
  for (const std::string& pattern : options.loops) add("--loops", pattern);
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + shell_quoted(word);
  return text;
}

ClipsPageRow row_of(const ClipsPageInput& in, const ClipReport& clip, const WorstMoment& worst, const Context& context) {
  ClipsPageRow row;
  row.file = clip.file, row.clip = clip.judged.speeds.clip;
  row.check = worst.finding.check, row.subject = worst.finding.subject;
  row.measured = worst.measured;
  if (worst.time_s) row.when = decimal(*worst.time_s, 3) + " s";
  row.counts = "All findings: " + counts_of_checks(clip);
  row.figure = clip.worst_pose;
  row.command = command_of(in.options, context, {clip.file});
  if (!row.clip.empty()) row.command += " --clip " + shell_quoted(row.clip);
  return row;
}

}  // namespace

Result<Done> check_clips_page(const std::string& folder) {
  if (folder.empty()) return Done{};
  const bool is_ours = beginning_of(folder + "/index.html", kBeginning).find(kOwnTitle) != std::string::npos;
  return check_own_folder(folder, is_ours, "a report of clips");
}

Result<Done> write_clips_page(const ClipsPageInput& in, const Context& context) {
  if (in.options.report.empty()) return Done{};
  ClipsPage page;
  page.command = command_of(in.options, context, in.options.files) + " --report " + shell_quoted(in.options.report);
  page.tool = CONTORT_VERSION, page.character = in.options.character, page.clips = in.clips.size();
  page.findings = count_findings(in.clips);
  for (const ClipReport& clip : in.clips) {
    const std::optional<WorstMoment> worst = worst_moment(clip);
    if (!worst) page.clean.push_back(clip.file + ": " + clip.judged.speeds.clip);
    if (worst && page.failing++ < kMostClipRows) page.rows.push_back(row_of(in, clip, *worst, context));
  }
  for (const auto& [file, issue] : in.unreadable) page.unreadable.push_back(file + ": " + to_line(issue));
  if (const Result<Done> made = make_folder(in.options.report); !made) return made;
  const std::string path = in.options.report + "/index.html";
  if (const Result<Done> written = write_file(path, clips_html(page)); !written) return written;
  if (!in.options.json) std::printf("report: %s\n", printable(path).c_str());
  return Done{};
}

}  // namespace contort::cli
