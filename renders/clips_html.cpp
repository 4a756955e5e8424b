#include "renders/clips_html.h"

#include <algorithm>

#include "renders/check_words.h"
#include "renders/html.h"
#include "renders/static_page.h"
#include "renders/wording.h"

namespace contort {

namespace {

constexpr std::string_view kClipsStyle =
    ".clip { display: grid; grid-template-columns: 160px 1fr; gap: 1rem; background: var(--card); padding: .8rem; "
    "border-bottom: 1px solid var(--line); }\n"
    ".clip h2 { font-size: 1rem; margin: 0; overflow-wrap: anywhere; }\n"
    ".clip p { margin: .3rem 0; }\n"
    ".clip .worst { color: var(--alarm); font-weight: 600; }\n"
    ".clip pre { overflow-x: auto; margin: .4rem 0 0; }\n"
    "svg.figure line { stroke: var(--bar); stroke-width: 5; stroke-linecap: round; }\n"
    "svg.figure line.marked { stroke: var(--alarm); }\n"
    "svg.figure circle.marked { fill: var(--alarm); }\n"
    "@media (max-width: 40rem) { .clip { grid-template-columns: 1fr; } }\n";

std::string worst_text(const ClipsPageRow& row) {
  std::string text = check_title(row.check) + ": " + row.subject;
  if (!row.measured.empty()) text += ", " + row.measured;
  return text + (row.when.empty() ? "" : ", at " + row.when);
}

std::string row_html(const ClipsPageRow& row, bool with_figure) {
  const std::string svg = with_figure ? stick_figure_svg(row.figure, "Pose where this happens: " + worst_text(row)) : "";
  return "<section class='clip'><div>" + svg + "</div><div><h2>" + html_text(row.file) + ": " + html_text(row.clip) +
         "</h2><p class='worst'>" + html_text(worst_text(row)) + "</p><p>" + html_text(row.counts) +
         "</p><pre><code>" + html_text(row.command) + "</code></pre></div></section>\n";
}

std::string names_html(const std::string& title, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::string html = "<details><summary>" + html_text(title) + "</summary><ul>";
  for (std::size_t i = 0; i < std::min(names.size(), kMostClipNames); ++i) html += "<li>" + html_text(names[i]) + "</li>";
  if (names.size() > kMostClipNames)
    html += "<li>and " + count_text(static_cast<std::int64_t>(names.size() - kMostClipNames)) + " more</li>";
  return html + "</ul></details>\n";
}

std::string verdict_html(const ClipsPage& page) {
  const auto count = [](std::size_t n, const char* one, const char* many) {
    return counted(static_cast<std::int64_t>(n), one, many);
  };
  const bool good = page.failing == 0 && page.unreadable.empty();
  const std::string on = page.character.empty() ? "" : ", judged as motions of " + page.character;
  const std::string unread =
      page.unreadable.empty() ? "" : count(page.unreadable.size(), "file", "files") + " cannot be read. ";
  return std::string("<header class='verdict ") + (good ? "good" : "bad") +
         "'><div class='page'><p class='title'>Contort check</p><h1>" + std::to_string(page.failing) + " of " +
         html_text(count(page.clips, "clip has", "clips have")) + " findings</h1><p class='detail'>" +
         html_text(count(page.findings, "finding", "findings") + on + ". " + unread +
                   "The worst clips come first, each with its worst finding.") +
         "</p></div></header>\n";
}

}  // namespace

std::string clips_html(const ClipsPage& page) {
  std::string body = verdict_html(page) + "<main class='page'>\n";
  const std::size_t shown = std::min(page.rows.size(), kMostClipRows);
  for (std::size_t i = 0; i < shown; ++i) body += row_html(page.rows[i], i < kMostClipFigures);
  if (page.failing > shown)
    body += "<p>" + count_text(static_cast<std::int64_t>(page.failing - shown)) +
            " more clips with findings are in the output of the command.</p>\n";
  body += names_html("Files that cannot be read", page.unreadable) + names_html("Clips without a finding", page.clean);
  body += "<h2>Again</h2>\n<pre><code>" + html_text(page.command) + "</code></pre>\n<p>Made by Contort " +
          html_text(page.tool) + ".</p>\n</main>\n";
  return static_page("Contort check", kClipsStyle, body);
}

}  // namespace contort
