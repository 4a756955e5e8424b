#include "renders/tested_html.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <string_view>

#include "checks/circumstances.h"
#include "renders/html.h"
#include "renders/not_judged_html.h"
#include "renders/report_cards.h"
#include "renders/wording.h"

namespace contort {

namespace {

// Greatest number of pairs, so that the page stays below a megabyte (report.h).
constexpr std::int64_t kMostListed = 500;

bool is_pair(std::string_view label) { return label.starts_with("pair "); }

// The pieces of "action reach (ik) on arm_left in blend" (fuzz/labels.h).
struct UseLabel {
  std::string action;
  std::string priority;
  std::string slot;
  std::string phase;  // "": in any phase
};

std::optional<UseLabel> use_of(std::string_view label) {
  constexpr std::string_view kAction = "action ", kOn = ") on ", kIn = " in ";
  const std::size_t open = label.find(" ("), on = label.find(kOn);
  if (!label.starts_with(kAction) || open == std::string_view::npos || on == std::string_view::npos || on < open)
    return {};
  UseLabel use;
  use.action = label.substr(kAction.size(), open - kAction.size());
  use.priority = label.substr(open + 2, on - open - 2);
  const std::string_view where = label.substr(on + kOn.size());
  const std::size_t in = where.find(kIn);
  use.slot = where.substr(0, in);
  if (in != std::string_view::npos) use.phase = where.substr(in + kIn.size());
  return use;
}

struct UseRow {
  UseLabel use;
  std::int64_t times = 0;
  std::map<std::string, std::int64_t, std::less<>> in_phase;
};

std::vector<UseRow> use_rows(const ReportModel& model) {
  std::map<std::string, UseRow> rows;  // by the label without the phase
  for (const auto& [label, count] : model.tested) {
    const std::optional<UseLabel> use = use_of(label);
    if (!use) continue;
    UseRow& row = rows[use->action + "\n" + use->priority + "\n" + use->slot];
    row.use = *use;
    (use->phase.empty() ? row.times : row.in_phase[use->phase]) += count;
  }
  std::vector<UseRow> all;
  for (auto& [label, row] : rows) all.push_back(std::move(row));
  return all;
}

std::string count_cell(std::int64_t count, bool must_be) {
  return (must_be && count == 0 ? "<td class='never'>" : "<td>") + html_text(count_text(count)) + "</td>";
}

// The phases in which an action can move a part: all except at_rest.
std::vector<std::string_view> phases_of_actions() {
  std::vector<std::string_view> phases(phase_names().begin(), phase_names().end());
  std::erase(phases, phase_name(Phase::at_rest));
  return phases;
}

std::string uses_html(const std::vector<UseRow>& rows) {
  if (rows.empty()) return "";
  std::string out =
      "<p>How often an action was drawn for a slot, and in how many of these uses it moved in each phase. Red: "
      "never.</p>\n"
      "<div class='wide' tabindex='0' role='region' aria-label='Actions by slot, priority and phase'>\n"
      "<table class='uses'>\n<thead><tr><th scope='col'>action</th><th scope='col'>priority</th>"
      "<th scope='col'>slot</th><th scope='col'>uses</th>";
  for (const std::string_view phase : phases_of_actions()) out += "<th scope='col'>" + html_text(phase) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const UseRow& row : rows) {
    out += std::string(row.times == 0 ? "<tr class='never'>" : "<tr>") + "<th scope='row'>" +
           html_text(row.use.action) + "</th><td>" + html_text(row.use.priority) + "</td><td>" +
           html_text(row.use.slot) + "</td>" + count_cell(row.times, true);
    for (const std::string_view phase : phases_of_actions()) {
      const auto found = row.in_phase.find(phase);
      out += count_cell(found == row.in_phase.end() ? 0 : found->second, row.times > 0);
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n</div>\n";
}

std::string pairs_html(const ReportModel& model) {
  const PairCounts pairs = pair_counts(model);
  if (pairs.possible == 0) return "";
  char share[32];
  std::snprintf(share, sizeof share, "%.0f %%",
                100.0 * static_cast<double>(pairs.drawn) / static_cast<double>(pairs.possible));
  std::string out = "<p>Pairs of actions whose times overlap on one part: " + html_text(count_text(pairs.drawn)) +
                    " of " + html_text(count_text(pairs.possible)) + " were drawn (" + share + ").</p>\n";
  if (pairs.drawn == pairs.possible) return out;
  out += "<details><summary>Those that never were</summary>\n<ul>\n";
  std::int64_t listed = 0;
  for (const auto& [label, count] : model.tested)
    if (is_pair(label) && count == 0 && ++listed <= kMostListed) out += "<li>" + html_text(label.substr(5)) + "</li>\n";
  if (listed > kMostListed) out += "<li>and " + html_text(count_text(listed - kMostListed)) + " more</li>\n";
  return out + "</ul>\n</details>\n";
}

// The other contents: characters, parts, objects, grounds, interrupts.
std::string others_html(const ReportModel& model) {
  const auto is_other = [](const auto& row) { return !is_pair(row.first) && !use_of(row.first); };
  std::int64_t largest = 0;
  for (const auto& row : model.tested)
    if (is_other(row)) largest = std::max(largest, row.second);
  std::string rows;
  for (const auto& row : model.tested)
    if (is_other(row))
      rows += (row.second == 0 ? "<tr class='never'><th scope='row'>" : "<tr><th scope='row'>") + html_text(row.first) +
              "</th><td>" + html_text(count_text(row.second)) + "</td><td>" + bar_html(row.second, largest) +
              "</td></tr>\n";
  if (rows.empty()) return "";
  return "<table>\n<thead><tr><th scope='col'>part of a case</th><th scope='col'>times</th><th></th></tr></thead>\n"
         "<tbody>\n" +
         rows + "</tbody>\n</table>\n";
}

}  // namespace

std::string bar_html(std::int64_t count, std::int64_t largest) {
  const double share = largest > 0 ? static_cast<double>(count) / static_cast<double>(largest) : 0.0;
  char width[32];
  std::snprintf(width, sizeof width, "%.2f", 100.0 * share);
  return "<svg class='bar' viewBox='0 0 100 1' preserveAspectRatio='none' aria-hidden='true'><rect height='1'" +
         attribute("width", width) + "/></svg>";
}

PairCounts pair_counts(const ReportModel& model) {
  PairCounts counts;
  for (const auto& [label, count] : model.tested) {
    counts.possible += is_pair(label);
    counts.drawn += is_pair(label) && count > 0;
  }
  return counts;
}

std::string tested_html(const ReportModel& model) {
  const std::string rest = not_judged_html(model);
  if (model.tested.empty() && rest.empty()) return "";
  return "<section id='tested'>\n<h2>What was tested</h2>\n" + rest + others_html(model) +
         uses_html(use_rows(model)) + pairs_html(model) + "</section>\n";
}

}  // namespace contort
