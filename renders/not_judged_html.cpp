#include "renders/not_judged_html.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "renders/check_words.h"
#include "renders/html.h"
#include "renders/report_cards.h"
#include "renders/wording.h"

namespace contort {

namespace {

constexpr std::size_t kMostReasonsOnPage = 50;

// The same lines as in `contort generator check`.
std::string refused_html(const ReportModel& model) {
  if (model.refused == 0) return "";
  std::string out = "<h3>Not judged</h3>\n<p>The generator refused " + html_text(count_text(model.refused)) + " of " +
                    html_text(counted(model.cases, "case", "cases")) +
                    ", so that nothing was judged in them.</p>\n<ul id='refused'>\n";
  for (const std::string& line : refusal_lines(model.refusals, model.refused, model.cases, kMostReasonsOnPage))
    out += "<li>" + html_text(line) + "</li>\n";
  return out + "</ul>\n";
}

using Counts = std::map<std::string, std::int64_t>;

// The labels, the most frequent first; equally frequent ones keep their order.
std::vector<std::pair<std::string_view, std::int64_t>> most_frequent_first(const Counts& counts) {
  std::vector<std::pair<std::string_view, std::int64_t>> rows(counts.begin(), counts.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return rows;
}

struct Table {
  std::string_view id;
  std::string_view title;
  std::string_view about;
  std::string_view subject;  // heading of the first column
};

// A label has the form "subject: reason". `subject_text` and `reason_text` put both into plain words.
template <class SubjectText, class ReasonText>
std::string table_html(const Table& table, const Counts& counts, SubjectText subject_text, ReasonText reason_text) {
  if (counts.empty()) return "";
  std::string out = "<details id='" + std::string(table.id) + "'>\n<summary>" + std::string(table.title) +
                    "</summary>\n<p>" + std::string(table.about) + "</p>\n<table>\n<thead><tr><th scope='col'>" +
                    std::string(table.subject) + "</th><th scope='col'>reason</th><th scope='col'>cases</th></tr></thead>" +
                    "\n<tbody>\n";
  for (const auto& [label, cases] : most_frequent_first(counts)) {
    const std::size_t colon = std::min(label.find(": "), label.size());
    out += "<tr><th scope='row'>" + html_text(subject_text(label.substr(0, colon))) + "</th><td>" +
           html_text(reason_text(label.substr(std::min(colon + 2, label.size())))) + "</td><td>" +
           html_text(count_text(cases)) + "</td></tr>\n";
  }
  return out + "</tbody>\n</table>\n</details>\n";
}

std::string unmet_html(const Counts& counts) {
  constexpr Table kTable{"unmet", "Requests that the generator could not meet",
                         "The generator came as near as it could and said so. These are notes, not failures.", "request"};
  return table_html(
      kTable, counts, [](std::string_view subject) { return subject; },
      [](std::string_view reason) { return shortfall_text(reason); });
}

std::string unable_html(const Counts& counts) {
  constexpr Table kTable{"not-judged", "Checks that could not judge",
                         "In these cases a check had nothing to judge. All other checks judged them.", "check"};
  return table_html(
      kTable, counts, [](std::string_view subject) { return check_title(subject); },
      [](std::string_view reason) { return reason; });
}

}  // namespace

std::string not_judged_html(const ReportModel& model) {
  return refused_html(model) + unmet_html(model.unmet) + unable_html(model.not_judged);
}

}  // namespace contort
