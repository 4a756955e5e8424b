#include "renders/search_html.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renders/html.h"
#include "renders/wording.h"

namespace contort {

namespace {

constexpr double kWide = 600.0, kHigh = 120.0;  // size of the curve, in its own units

// "2 500": one of so many cases.
std::string one_of(double share) {
  return count_text(share > 0.0 ? static_cast<std::int64_t>(std::floor(1.0 / share)) : 0);
}

constexpr std::int64_t kFewCases = 30;  // with fewer cases nothing can be estimated

std::string what_is_left(const SearchProgress& search) {
  const std::string cases = one_of(unseen_share(search));
  if (search.cases < kFewCases) return "These are too few cases to say how many kinds of failure are left.";
  if (search.failing == 0)
    return "With 95 % confidence, fewer than 1 in " + cases + " of the cases that this run draws would.";
  if (search.lone_cases == 0)
    return "Each was met by two cases or more, so probably fewer than 1 in " + cases +
           " further cases would show another one.";
  return "Estimate: one of " + cases + " further cases would show a new kind of failure.";
}

void add_point(std::string& path, const char* move, double cases, double families, const SearchProgress& search) {
  char text[64];
  std::snprintf(text, sizeof text, "%s%.1f %.1f", move, kWide * cases / static_cast<double>(search.cases),
                kHigh * (1.0 - families / static_cast<double>(search.discovered.size())));
  path += text;
}

// The number of families over the number of cases, as steps.
std::string curve_html(const SearchProgress& search) {
  if (search.discovered.empty()) return "";
  std::string path;
  add_point(path, "M", 0.0, 0.0, search);
  for (std::size_t i = 0; i < search.discovered.size(); ++i) {
    const auto at = static_cast<double>(search.discovered[i]);
    add_point(path, "L", at, static_cast<double>(i), search);
    add_point(path, "L", at, static_cast<double>(i + 1), search);
  }
  add_point(path, "L", static_cast<double>(search.cases), static_cast<double>(search.discovered.size()), search);
  return "<figure class='curve'><figcaption>Kinds of failure met, up to " +
         html_text(count_text(static_cast<std::int64_t>(search.discovered.size()))) + ", over " +
         html_text(counted(search.cases, "case", "cases")) +
         "</figcaption><svg viewBox='0 -4 600 128' preserveAspectRatio='none' aria-hidden='true'><path d='" + path +
         "'/></svg></figure>\n";
}

std::string cell(std::int64_t count) { return "<td>" + html_text(count_text(count)) + "</td>"; }

std::string arms_html(const SearchProgress& search) {
  std::string out =
      "<table class='arms'>\n<thead><tr><th scope='col'>way of drawing</th><th scope='col'>cases</th>"
      "<th scope='col'>failing</th><th scope='col'>kinds of failure it met first</th></tr></thead>\n<tbody>\n";
  for (const ArmProgress& arm : search.arms)
    out += "<tr><th scope='row'>" + html_text(arm.name) + "</th>" + cell(arm.cases) + cell(arm.failing) +
           cell(arm.families) + "</tr>\n";
  return out + "</tbody>\n</table>\n";
}

}  // namespace

std::string outlook(const SearchProgress& search) {
  if (search.cases == 0) return "";
  const auto families = static_cast<std::int64_t>(search.discovered.size());
  const std::string met = families == 0
                              ? "No case failed."
                              : "The last of " + counted(families, "kind of failure", "kinds of failure") +
                                    " was met after " + count_text(search.discovered.back()) + " of " +
                                    counted(search.cases, "case", "cases") + ".";
  const bool guided =
      std::ranges::any_of(search.arms, [](const ArmProgress& arm) { return arm.name == "guided" && arm.cases > 0; });
  return met + " " + what_is_left(search) +
         (guided ? " Guided cases follow others, which makes this an estimate." : "");
}

std::string search_html(const SearchProgress& search) {
  if (search.cases == 0) return "";
  return "<section id='search'>\n<h2>How far the search got</h2>\n<p>" + html_text(outlook(search)) + "</p>\n" +
         curve_html(search) + arms_html(search) + "</section>\n";
}

}  // namespace contort
