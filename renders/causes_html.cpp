#include "renders/causes_html.h"

#include <algorithm>
#include <cstdio>

#include "renders/html.h"
#include "renders/wording.h"

namespace contort {

namespace {

constexpr std::size_t kMostCauses = 30;  // of a page, which has to stay small

std::string headline_html(const ReportCause& cause, const PageFiles& inside) {
  const bool opens = !cause.key.empty() && (inside.empty() || inside.contains("cases/" + cause.key + ".json"));
  const std::string text = html_text(cause.headline);
  return opens ? "<a href='#case=" + html_text(cause.key) + "'>" + text + "</a>" : text;
}

std::string severity_text(double severity) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", severity);
  return text;
}

// When it fails, below its headline: a line for each character.
std::string conditions_html(const ReportCause& cause) {
  std::string out;
  for (const auto& [character, sentence] : cause.conditions)
    out += "<p class='when'>" + html_text(character + ": " + sentence) + "</p>";
  return out;
}

std::string row_html(const ReportCause& cause, const PageFiles& inside) {
  std::string characters;
  for (const std::string& name : cause.characters) characters += (characters.empty() ? "" : ", ") + name;
  return "<tr><th scope='row'>" + headline_html(cause, inside) + conditions_html(cause) + "</th><td>" +
         html_text(characters) + "</td><td>" + html_text(count_text(cause.cases)) + "</td><td>" +
         html_text(count_text(std::ssize(cause.buckets))) + "</td><td>" + severity_text(cause.severity) + "</td></tr>\n";
}

}  // namespace

std::string causes_html(const ReportModel& model, const PageFiles& inside) {
  if (model.causes.empty()) return "";
  const std::size_t shown = std::min(model.causes.size(), kMostCauses);
  std::string out =
      "<section id='causes'>\n<h2>Causes</h2>\n<p class='order'>Failures that the same actions or the same "
      "surroundings explain have one row. The most severe cause comes first.</p>\n<table class='causes'>\n<thead><tr>"
      "<th scope='col'>Cause</th><th scope='col'>Characters</th><th scope='col'>Cases</th><th scope='col'>Failures</th>"
      "<th scope='col'>Severity</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < shown; ++i) out += row_html(model.causes[i], inside);
  out += "</tbody>\n</table>\n";
  const auto others = static_cast<std::int64_t>(model.causes.size() - shown);
  if (others > 0)
    out += "<p class='rest'>" + html_text(counted(others, "more cause", "more causes")) + " in report.json.</p>\n";
  return out + "</section>\n";
}

}  // namespace contort
