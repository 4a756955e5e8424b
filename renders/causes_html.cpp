#include "renders/causes_html.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "renders/check_words.h"
#include "renders/glossary.h"
#include "renders/html.h"
#include "renders/report_cards.h"
#include "renders/thumb.h"
#include "renders/wording.h"

namespace contort {

namespace {

constexpr std::size_t kFirstCauses = 10;   // the others are folded away
constexpr std::size_t kMostCauses = 30;    // of a page, which must stay small
constexpr std::size_t kMostFailures = 10;  // of a cause
constexpr std::size_t kMostNames = 4;      // of characters

// The rows of failures, by the id of their bucket.
using RowsById = std::map<std::string_view, const ReportRow*>;

RowsById rows_by_id(const ReportModel& model) {
  RowsById rows;
  for (const ReportRow& row : model.rows) rows.emplace(row.bucket, &row);
  return rows;
}

std::vector<const ReportRow*> rows_of_cause(const ReportCause& cause, const RowsById& rows) {
  std::vector<const ReportRow*> found;
  for (const std::string& id : cause.buckets)
    if (const auto at = rows.find(id); at != rows.end()) found.push_back(at->second);
  return found;
}

std::string case_link(const std::string& key, const std::string& text, bool opens) {
  return opens ? "<a href='#case=" + html_text(key) + "'>" + html_text(text) + "</a>" : html_text(text);
}

bool opens_case(const ReportCause& cause, const PageFiles& inside) {
  return !cause.key.empty() && (inside.empty() || inside.contains("cases/" + cause.key + ".json"));
}

// The picture of the cause's deepest case.
std::string cause_picture(const ReportCause& cause, const std::vector<const ReportRow*>& rows,
                          const PageFiles& inside) {
  const auto deepest = std::ranges::find(rows, cause.key, &ReportRow::key);
  const std::string thumb = deepest == rows.end() ? "" : thumb_html(**deepest, inside);
  return thumb.empty() ? "<span class='thumb'></span>" : thumb;
}

// The value and the limit of the cause's deepest case, below the headline.
std::string measured_html(const ReportCause& cause, const std::vector<const ReportRow*>& rows) {
  const auto deepest = std::ranges::find(rows, cause.key, &ReportRow::key);
  if (deepest == rows.end() || (*deepest)->sentence.empty()) return "";
  return "<span class='worst'>at worst " + html_text((*deepest)->sentence) + "</span>";
}

// ---- the unfolded part of a row

// A line for each character for which a rule was learned.
std::string conditions_html(const ReportCause& cause) {
  std::string out;
  for (const auto& [character, sentence] : cause.conditions)
    out += "<p class='when'>" + html_text(character + ": " + sentence) + "</p>\n";
  return out;
}

std::string failure_line(const ReportRow& row, const PageFiles& inside) {
  const std::string value = value_text(row);
  return "<li>" + case_link(row.key, row.subject, can_be_opened(row, inside)) + " <span class='dim'>" +
         html_text(check_title(row.check) + (value.empty() ? "" : "; ") + value + "; " + row.state) + "</span></li>\n";
}

std::string failures_of_cause(const std::vector<const ReportRow*>& rows, const PageFiles& inside) {
  if (rows.empty()) return "";
  std::string out = "<ul class='members'>\n";
  for (std::size_t i = 0; i < std::min(rows.size(), kMostFailures); ++i) out += failure_line(*rows[i], inside);
  const auto others = std::ssize(rows) - static_cast<std::ptrdiff_t>(std::min(rows.size(), kMostFailures));
  if (others > 0) out += "<li class='dim'>" + html_text(counted(others, "more failure", "more failures")) + "</li>\n";
  return out + "</ul>\n";
}

std::string unfolded_html(const ReportCause& cause, const std::vector<const ReportRow*>& rows,
                          const PageFiles& inside) {
  const std::string body = conditions_html(cause) + failures_of_cause(rows, inside) +
                           (rows.empty() ? "" : command_html(rows.front()->replay_command));
  const std::string count = html_text(count_text(std::ssize(cause.buckets))) + " " +
                            term_html("failure", cause.buckets.size() == 1 ? "failure" : "failures");
  if (body.empty()) return "<p class='dim'>" + count + "</p>";
  return "<details><summary>" + count + (cause.conditions.empty() ? "" : ", when") + ", how to see it</summary>\n" +
         body + "</details>";
}

// ---- columns

std::string novelty_html(const ReportCause& cause, const std::vector<const ReportRow*>& rows) {
  if (is_news(cause.news))
    return "<span class='chip state-new'>" + std::string(cause_news_names()[static_cast<std::size_t>(cause.news)]) +
           "</span>";
  if (cause.news == CauseNews::rare)
    return "<span class='chip'>rare</span> <span class='dim'>too rare to say</span>";
  const auto fresh = std::ranges::count_if(rows, [](const ReportRow* row) { return row->gating; });
  const std::string more = fresh == 0 ? "" : " <span class='dim'>" + html_text(count_text(fresh)) + " new in it</span>";
  return "<span class='chip'>known</span>" + more;
}

std::string often_html(const ReportCause& cause, std::int64_t cases) {
  if (cases <= 0) return html_text(counted(cause.cases, "case", "cases"));
  return "<b>" + html_text(share_text(cause.cases, cases)) + "</b> <span class='dim'>" +
         html_text(count_text(cause.cases) + " of " + counted(cases, "case", "cases")) + "</span>";
}

std::string names_html(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > kMostNames) text += ", and " + std::to_string(names.size() - kMostNames) + " more";
  return html_text(text);
}

std::string severity_html(double severity) {
  return "<b>" + severity_word(severity) + "</b> <span class='dim'>" + html_text(rounded_text(severity)) +
         " of 100</span>";
}

std::string row_html(const ReportCause& cause, const ReportModel& model, const RowsById& by_id,
                     const PageFiles& inside) {
  const std::vector<const ReportRow*> rows = rows_of_cause(cause, by_id);
  const auto cell = [](const char* name, const std::string& html) {
    return "<td class='" + std::string(name) + "'>" + html + "</td>";
  };
  return "<tr><td class='picture' rowspan='2'>" + cause_picture(cause, rows, inside) +
         "</td><th scope='row'><span class='headline'>" +
         case_link(cause.key, cause.headline, opens_case(cause, inside)) + "</span>" + measured_html(cause, rows) +
         "</th>" + cell("novelty", novelty_html(cause, rows)) +
         cell("severity", severity_html(cause.severity)) + cell("often", often_html(cause, model.cases)) +
         cell("who", names_html(cause.characters)) + "</tr>\n<tr class='unfold'><td colspan='5'>" +
         unfolded_html(cause, rows, inside) + "</td></tr>\n";
}

// Text such as "3 are".
std::string new_text(std::int64_t fresh, std::int64_t all) {
  if (fresh == 0) return all == 1 ? "it is not" : "none is";
  if (fresh == all) return all == 1 ? "it is" : "all are";
  return html_text(count_text(fresh)) + (fresh == 1 ? " is" : " are");
}

std::string intro_html(const ReportModel& model) {
  std::int64_t failures = 0;
  for (const ReportCause& cause : model.causes) failures += std::ssize(cause.buckets);
  const auto fresh = std::ranges::count(model.causes, CauseNews::fresh, &ReportCause::news);
  const std::int64_t causes = std::ssize(model.causes);
  const std::string since = model.has_baseline ? " since the " + term_html("baseline") : "";
  return "<p class='order'>" + html_text(count_text(causes)) + " " +
         term_html("cause", causes == 1 ? "cause" : "causes") + (causes == 1 ? " explains " : " explain ") +
         html_text(counted(failures, "failure", "failures")) + "; " + new_text(fresh, causes) + " new" + since +
         (model.has_baseline ? ". What is news comes first, then the most severe.</p>\n"
                             : ". The most severe comes first.</p>\n");
}

std::string head_row() {
  const auto column = [](const std::string& html) { return "<th scope='col'>" + html + "</th>"; };
  return "<thead><tr>" + column("<span class='unseen'>Worst frame</span>") + column(term_html("cause", "Cause")) +
         column(term_html("state", "New?")) + column(term_html("severity", "Severity")) +
         column("How often") + column("Characters") + "</tr></thead>\n";
}

std::string table_of_causes(std::span<const ReportCause> causes, const ReportModel& model, const PageFiles& inside) {
  const RowsById by_id = rows_by_id(model);
  std::string out = "<table class='causes'>\n" + head_row() + "<tbody>\n";
  for (const ReportCause& cause : causes) out += row_html(cause, model, by_id, inside);
  return out + "</tbody>\n</table>\n";
}

}  // namespace

std::string severity_word(double severity) {
  static constexpr std::pair<double, const char*> kWords[] = {{20.0, "very high"}, {5.0, "high"}, {1.0, "medium"}};
  for (const auto& [least, word] : kWords)
    if (severity >= least) return word;
  return "low";
}

std::string causes_html(const ReportModel& model, const PageFiles& inside) {
  if (model.causes.empty()) return "";
  const auto first = std::min(model.causes.size(), kFirstCauses), shown = std::min(model.causes.size(), kMostCauses);
  const std::span<const ReportCause> causes(model.causes);
  std::string out = "<section id='causes'>\n<h2>What is wrong</h2>\n" + intro_html(model) +
                    table_of_causes(causes.first(first), model, inside);
  if (first < shown)
    out += "<details><summary>" +
           html_text(counted(static_cast<std::int64_t>(shown - first), "less severe cause", "less severe causes")) +
           "</summary>\n" + table_of_causes(causes.subspan(first, shown - first), model, inside) + "</details>\n";
  const auto others = static_cast<std::int64_t>(model.causes.size() - shown);
  if (others > 0)
    out += "<p class='left-out'>" + html_text(counted(others, "more cause", "more causes")) + " in report.json.</p>\n";
  return out + "</section>\n";
}

}  // namespace contort
