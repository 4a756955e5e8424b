// Writes Markdown for the page of a build, and the lines that GitHub shows beside the code.
#include <algorithm>
#include <map>

#include "renders/ci_outputs.h"
#include "renders/wording.h"

namespace contort {

namespace {

// ---- Markdown

// Escapes text so that Markdown shows it unchanged. Only special characters get a backslash, because elsewhere it would
// be visible.
std::string md_text(const std::string& text) {
  constexpr std::string_view kSigns = "\\`*_{}[]<>()#+!|~&$@:";
  std::string escaped;
  for (const char c : one_line(text)) {
    if (kSigns.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

// Does not use backticks: nothing can be escaped between them, and a bar after a backslash would end the table's cell.
std::string md_code(const std::string& text) { return "<code>" + md_text(text) + "</code>"; }

// Text such as "2 new, 1 regressed".
std::string counts_text(const ReportModel& model, bool gating) {
  std::map<std::string, std::int64_t> counts;
  for (const ReportRow& row : model.rows)
    if (row.gating == gating) ++counts[row.state];
  std::string text;
  for (const auto& [state, count] : counts) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + state;
  return text;
}

std::string md_row(const ReportRow& row) {
  return "| " + md_text(row.state) + " | " + md_text(row.check) + " " + md_text(row.subject) + " | " +
         md_text(value_text(row)) + ", frame " + std::to_string(row.worst_frame) + " | " +
         std::to_string(row.cases_seen) + " | " + md_code(row.replay_command) + " |\n";
}

// ---- GitHub's workflow commands

// Escapes the characters that would end a property or a line.
std::string command_text(const std::string& text, bool in_property) {
  std::string escaped;
  for (const char c : one_line(text)) {
    if (c == '%')
      escaped += "%25";
    else if (in_property && c == ':')
      escaped += "%3A";
    else if (in_property && c == ',')
      escaped += "%2C";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace

std::string markdown_summary(const ReportModel& model) {
  const std::vector<const ReportRow*> rows = gating_first(model);
  const auto gating =
      static_cast<std::size_t>(std::ranges::count_if(rows, [](const ReportRow* row) { return row->gating; }));
  std::string out = "## " + md_text(model.title) + ": " + gate_text(model) + "\n\n";
  if (gating > 0) out += md_text(counts_text(model, true)) + ". ";
  const std::string known = counts_text(model, false);
  out += "Known: " + (known.empty() ? "none" : md_text(known)) + ". " + std::to_string(model.cases) + " cases, " +
         std::to_string(model.frames) + " frames.\n";
  if (model.unsettled > 0) out += "\n" + md_text(unsettled_text(model.unsettled)) + "\n";
  if (gating == 0) return out;
  out += "\n| state | failure | worst | cases | see it again |\n|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < std::min(gating, kMostMarkdownRows); ++i) out += md_row(*rows[i]);
  if (gating > kMostMarkdownRows) out += "\n" + std::to_string(gating - kMostMarkdownRows) + " more\n";
  return out;
}

std::vector<std::string> github_annotations(const ReportModel& model) {
  std::vector<std::string> lines;
  std::size_t more = 0;
  for (const ReportRow* row : gating_first(model)) {
    if (!row->gating) break;
    if (lines.size() == kMostAnnotations) {
      ++more;
      continue;
    }
    lines.push_back("::error file=" + command_text(row->case_file, true) +
                    ",title=" + command_text(row->state + " " + row->check, true) +
                    "::" + command_text(row->family + ", " + value_text(*row), false) + "  " +
                    command_text(row->replay_command, false));
  }
  if (more > 0) lines.push_back("::notice::" + std::to_string(more) + " more");
  return lines;
}

}  // namespace contort
