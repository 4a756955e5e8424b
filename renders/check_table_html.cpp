#include "renders/check_table_html.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "renders/check_words.h"
#include "renders/glossary.h"
#include "renders/html.h"
#include "renders/report_cards.h"
#include "renders/tested_html.h"
#include "renders/wording.h"

namespace contort {

namespace {

constexpr std::size_t kMostColumns = 8;  // the failures of further characters are only in the total

// The failures of a check, by character.
struct CheckRow {
  std::string check;
  std::map<std::string, std::int64_t> failures;
  std::int64_t total = 0;
};

// The check with the most failures comes first.
std::vector<CheckRow> check_rows(const ReportModel& model) {
  std::map<std::string, CheckRow> by_check;
  for (const ReportRow& row : model.rows) {
    if (row.state == "fixed") continue;
    CheckRow& of = by_check[row.check];
    of.check = row.check;
    ++of.failures[row.character], ++of.total;
  }
  std::vector<CheckRow> rows;
  for (auto& [check, row] : by_check) rows.push_back(std::move(row));
  std::ranges::stable_sort(rows, std::greater(), &CheckRow::total);
  return rows;
}

std::int64_t failures_on(const CheckRow& row, const std::string& character) {
  const auto found = row.failures.find(character);
  return found == row.failures.end() ? 0 : found->second;
}

// The characters with the most failures first.
std::vector<std::string> columns_of(const std::vector<CheckRow>& rows) {
  std::map<std::string, std::int64_t> totals;
  for (const CheckRow& row : rows)
    for (const auto& [character, count] : row.failures) totals[character] += count;
  std::vector<std::string> names;
  for (const auto& [name, count] : totals) names.push_back(name);
  std::ranges::stable_sort(names, std::greater(), [&](const std::string& name) { return totals[name]; });
  if (names.size() > kMostColumns) names.resize(kMostColumns);
  return names;
}

// Runs count the cases of each character under the label "character human".
std::string cases_of(const ReportModel& model, const std::string& character) {
  const std::string label = "character " + character;
  const auto found = std::ranges::find_if(model.tested, [&](const auto& row) { return row.first == label; });
  if (found == model.tested.end()) return "";
  return "<span class='dim'>" + html_text(counted(found->second, "case", "cases")) + "</span>";
}

std::string failures_cell(std::int64_t count, std::int64_t largest) {
  if (count == 0) return "<td class='zero'>0</td>";
  return "<td>" + html_text(count_text(count)) + bar_html(count, largest) + "</td>";
}

std::string check_head(const ReportModel& model, const std::vector<std::string>& columns) {
  std::string out = "<thead><tr><th scope='col'>Check</th>";
  for (const std::string& name : columns)
    out += "<th scope='col'>" + html_text(name.empty() ? "no character" : name) + cases_of(model, name) + "</th>";
  return out + "<th scope='col'>all</th></tr></thead>\n";
}

std::string check_line(const CheckRow& row, const std::vector<std::string>& columns, std::int64_t largest) {
  std::string out = "<tr><th scope='row'>" + html_text(check_title(row.check)) + " <span class='dim'>" +
                    html_text(row.check) + "</span></th>";
  for (const std::string& name : columns) out += failures_cell(failures_on(row, name), largest);
  return out + "<td>" + html_text(count_text(row.total)) + "</td></tr>\n";
}

}  // namespace

std::string check_table_html(const ReportModel& model) {
  const std::vector<CheckRow> rows = check_rows(model);
  if (rows.empty()) return "";
  const std::vector<std::string> columns = columns_of(rows);
  std::int64_t largest = 0;
  for (const CheckRow& row : rows)
    for (const auto& [character, count] : row.failures) largest = std::max(largest, count);
  std::string out = "<section id='checks'>\n<h2>Which checks fail on which characters</h2>\n<p class='order'>"
                    "Numbers of " +
                    term_html("failure", "failures") +
                    " that are not fixed.</p>\n<div class='wide' tabindex='0' role='region' "
                    "aria-label='Failures by check and character'>\n<table class='checks'>\n" +
                    check_head(model, columns) + "<tbody>\n";
  for (const CheckRow& row : rows) out += check_line(row, columns, largest);
  return out + "</tbody>\n</table>\n</div>\n</section>\n";
}

}  // namespace contort
