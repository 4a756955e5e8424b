#include "cli/judged_text.h"

#include <algorithm>

#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

using json_fields::Json;

std::string count_of(std::int64_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::string judged_on(const JudgedSummary& summary) {
  std::string text;
  if (summary.channel_count > 0)
    text += ", " + (summary.channels < summary.channel_count ? std::to_string(summary.channels) + " of " : "") +
            count_of(summary.channel_count, "channel");
  if (summary.joint_count > 0)
    text += ", " + std::to_string(summary.joints) + " of " + count_of(summary.joint_count, "joint");
  const auto range = summary.checks.find("joint_range");
  if (range != summary.checks.end() && range->second.subjects > 0)
    text += ", " + count_of(range->second.subjects, "limit");
  if (summary.frames > 0) text += ", " + count_of(summary.frames, "frame");
  if (summary.motions > 1) text += ", in " + count_of(summary.motions, "motion");
  return text.empty() ? " on nothing" : " on" + text.substr(1);
}

// Text such as "joint_range 61, pop 22", in the manifest's order.
std::string subjects_text(const JudgedSummary& summary) {
  std::string text;
  for (const CheckDef& check : all_checks()) {
    const auto tally = summary.checks.find(check.name);
    if (tally == summary.checks.end() || tally->second.motions == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(check.name) + " " + std::to_string(tally->second.subjects);
  }
  return text;
}

// Reasons with one cure for many checks: these are named in one line.
struct SharedReason {
  std::string_view mark, line;
};
constexpr SharedReason kShared[] = {
    {"(--character)", "  Without a character (--character) could not judge: "},
    {"the generator is not a program of its own", "  Only for external generators (--generator): "},
    {"the motion is not a clip of an animation file", "  Only for clips of animation files: "}};

bool is_shared(std::string_view reason) {
  return std::ranges::any_of(kShared, [&](const SharedReason& shared) { return reason.find(shared.mark) != std::string_view::npos; });
}

void add_reasons(const JudgedSummary& summary, std::string_view check, std::vector<std::string>& lines) {
  for (const auto& [reason, motions] : summary.checks.at(check).reasons) {
    if (is_shared(reason)) continue;
    const std::string where = summary.motions > 1 && motions < summary.motions
                                  ? " in " + std::to_string(motions) + " of " + std::to_string(summary.motions)
                                  : "";
    lines.push_back("  " + std::string(check) + " could not judge" + where + ": " + std::string(reason));
  }
}

void add_shared(const JudgedSummary& summary, const SharedReason& shared, std::vector<std::string>& lines) {
  std::string names;
  for (const CheckDef& check : all_checks())
    if (const auto tally = summary.checks.find(check.name); tally != summary.checks.end())
      for (const auto& [reason, motions] : tally->second.reasons)
        if (reason.find(shared.mark) != std::string_view::npos) names += (names.empty() ? "" : ", ") + std::string(check.name);
  if (!names.empty()) lines.push_back(std::string(shared.line) + names);
}

}  // namespace

void JudgedSummary::add(const std::vector<JudgedCheck>& judged, const std::vector<NotJudged>& not_judged) {
  ++motions;
  for (const JudgedCheck& check : judged) {
    JudgedTally& tally = checks[check.check];
    ++tally.motions, tally.subjects = std::max(tally.subjects, check.subjects);
  }
  for (const NotJudged& check : not_judged) ++checks[check.check].reasons[check.reason];
}

std::vector<std::string> judged_lines(const JudgedSummary& summary) {
  const auto count = std::ranges::count_if(summary.checks, [](const auto& entry) { return entry.second.motions > 0; });
  std::vector<std::string> lines = {"Judged: " + count_of(count, "check") + judged_on(summary)};
  if (count > 0) lines.push_back("  " + subjects_text(summary));
  for (const auto& [kind, channels] : summary.not_read)
    lines.push_back("  not read: " + count_of(channels, "channel") + " (" + kind + ")");
  for (const CheckDef& check : all_checks())
    if (summary.checks.contains(check.name)) add_reasons(summary, check.name, lines);
  for (const SharedReason& shared : kShared) add_shared(summary, shared, lines);
  return lines;
}

std::string judged_json(const std::vector<JudgedCheck>& judged) {
  Json list = Json::array();
  for (const JudgedCheck& check : judged) list.push_back({{"check", check.check}, {"subjects", check.subjects}});
  return list.dump();
}

std::string not_judged_json(const std::vector<NotJudged>& not_judged) {
  Json list = Json::array();
  for (const NotJudged& check : not_judged) list.push_back({{"check", check.check}, {"reason", check.reason}});
  return list.dump();
}

}  // namespace contort::cli
