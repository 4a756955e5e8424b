#include "renders/audit_html.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <span>

#include "renders/html.h"
#include "renders/static_page.h"

namespace contort {

namespace {

constexpr int kEnough_permille = 990;  // an action with at least this share of clean motions counts as clean

bool is_clean(const AuditPageRow& row) { return std::int64_t{1000} * row.clean >= std::int64_t{kEnough_permille} * row.draws; }

std::string percent_of(int count, int of) {
  char text[16];
  std::snprintf(text, sizeof text, "%.1f %%", 100.0 * count / of);
  return text;
}

constexpr std::string_view kOwnStyle =
    "table.audit { border-collapse: collapse; width: 100%; background: var(--card); }\n"
    "table.audit th, table.audit td { text-align: left; vertical-align: top; padding: .4rem .6rem; border-bottom: 1px solid var(--line); }\n"
    "table.audit th { font-size: .8125rem; color: var(--dim); }\n"
    "table.audit td.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }\n"
    "tr.bad td.clean { color: var(--alarm); font-weight: 600; }\n"
    "meter { width: 5rem; }\n"
    "td img { display: block; max-width: 26rem; width: 100%; height: auto; margin-top: .4rem; }\n"
    "details summary { color: var(--accent); cursor: pointer; }\n"
    ".scroll { overflow-x: auto; }\n";

std::string worst_html(const AuditPageRow& row) {
  if (row.spec.empty()) return "";
  std::string html = "<details><summary>Worst motion</summary><a href='" + html_url(row.spec) + "'>Specification</a>";
  if (!row.picture.empty())
    html += "<img loading='lazy' src='" + html_url(row.picture) + "' alt='" +
            html_text("Film strip of the worst motion of " + row.action + " on " + row.part) + "'>";
  return html + "</details>";
}

std::string row_html(const AuditPageRow& row) {
  const std::string share = percent_of(row.clean, row.draws);
  return std::string("<tr class='") + (is_clean(row) ? "good" : "bad") + "'><th scope='row'>" + html_text(row.part) +
         "</th><td>" + html_text(row.action) + "</td><td class='number clean'><meter min='0' max='" +
         std::to_string(row.draws) + "' value='" + std::to_string(row.clean) + "' aria-hidden='true'></meter> " + share +
         "</td><td class='number'>" + percent_of(row.unmet, row.draws) + "</td><td class='number'>" +
         percent_of(row.still, row.draws) + "</td><td>" + html_text(row.details) + worst_html(row) + "</td></tr>\n";
}

std::string table_html(std::span<const AuditPageRow* const> rows) {
  std::string html =
      "<h2>" + html_text(rows.front()->character) +
      "</h2>\n<div class='scroll' tabindex='0' role='region' aria-label='" + html_text(rows.front()->character) +
      "'><table class='audit'>\n<thead><tr><th scope='col'>Part</th><th scope='col'>Action</th><th scope='col'>Clean</th>"
      "<th scope='col'>Unmet</th><th scope='col'>Still</th><th scope='col'>Findings and reasons</th></tr></thead>\n<tbody>\n";
  for (const AuditPageRow* row : rows) html += row_html(*row);
  return html + "</tbody></table></div>\n";
}

// The rows by character, in the page's order. For each character, rows with the smallest share of clean motions come
// first, then those with most unmet requests.
std::vector<std::vector<const AuditPageRow*>> by_character(const std::vector<AuditPageRow>& rows) {
  std::vector<std::vector<const AuditPageRow*>> groups;
  for (const AuditPageRow& row : rows) {
    const auto group = std::ranges::find_if(groups, [&](const auto& g) { return g.front()->character == row.character; });
    group == groups.end() ? groups.push_back({&row}) : group->push_back(&row);
  }
  for (auto& group : groups)
    std::ranges::stable_sort(group, [](const AuditPageRow* a, const AuditPageRow* b) {
      const std::int64_t clean_a = std::int64_t{a->clean} * b->draws, clean_b = std::int64_t{b->clean} * a->draws;
      if (clean_a != clean_b) return clean_a < clean_b;
      return std::int64_t{a->unmet} * b->draws > std::int64_t{b->unmet} * a->draws;
    });
  return groups;
}

std::string verdict_html(const AuditPage& page, std::size_t clean) {
  const bool all = clean == page.rows.size();
  const std::string verdict = std::to_string(clean) + " of " + std::to_string(page.rows.size()) + " actions are clean";
  return std::string("<header class='verdict ") + (all ? "good" : "bad") +
         "'><div class='page'><p class='title'>Contort audit</p><h1>" + verdict +
         "</h1><p class='detail'>Each action alone, on a figure that stands at rest, over all parameters that it declares. It counts "
         "as clean if 99 % of its motions have no finding. Unmet: the generator could not do what was asked for, and says so. "
         "Still: nothing moved.</p></div></header>\n";
}

}  // namespace

std::string audit_html(const AuditPage& page) {
  const auto clean = static_cast<std::size_t>(std::ranges::count_if(page.rows, is_clean));
  std::string body = verdict_html(page, clean) + "<main class='page'>\n";
  for (const auto& group : by_character(page.rows)) body += table_html(group);
  body += "<h2>Again</h2>\n<pre><code>" + html_text(page.command) + "</code></pre>\n<p>Made by Contort " +
          html_text(page.tool) + ".</p>\n</main>\n";
  return static_page("Contort audit", kOwnStyle, body);
}

}  // namespace contort
