#include "renders/glossary.h"

#include <utility>

#include "renders/html.h"

namespace contort {

namespace {

constexpr std::pair<std::string_view, std::string_view> kGlossary[] = {
    {"case", "One motion that was made and checked: a character, its actions and its surroundings. It is clean if no "
             "check failed."},
    {"failure", "One way to break a check, with the smallest case that does it. Its folder in the corpus is called a "
                "bucket."},
    {"cause", "The explanation of failures: an action that fails alone, several that fail only together, or the "
              "surroundings of the figure. It is found by playing each action of the smallest case alone."},
    {"severity", "A number from 0 to 100 that orders the causes: by depth, frequency, visibility, and how little is needed "
                 "to cause the failure. Very high from 20, high from 5, medium from 1, else low."},
    {"minimal case", "The smallest case that still shows the failure: everything that it does not need was removed."},
    {"baseline", "The failures that were known before, such as those of last night. They do not fail the build."},
    {"kind of failure", "All failures of one check in one place of a character, such as a joint, or two bodies that "
                        "collide. Files call it a family."},
    {"margin", "The distance of a value from its limit. Below 0 the limit is violated; \"worst\" is the smallest margin."},
    {"needs", "Everything without which the failure does not happen. Look for its cause there."},
    {"comes with", "Other kinds of failure that the smallest case shows as well. They are not listed as separate "
                   "failures for that."},
    {"in the base", "The result of the other build of a comparison (contort fuzz --against) for the same case."},
    {"phase", "The event in the worst frame, such as an interrupt that had just cut in."},
    {"state", "new: nobody has looked at it. open: somebody is responsible for it. regressed: it was fixed and is "
              "back. fixed: gone. quarantined: it may fail until a day. flaky: two runs differ. waiting: time "
              "was up before it could be shrunk. unconfirmed: seen once, but not in a second run."},
    {"fails the build", "A failure that makes an automatic build stop, which files call gating: new, regressed and "
                        "waiting failures do."}};

}  // namespace

std::string_view meaning_of(std::string_view word) {
  for (const auto& [known, meaning] : kGlossary)
    if (known == word) return meaning;
  return "";
}

std::string term_html(std::string_view word, std::string_view text) {
  const std::string_view meaning = meaning_of(word);
  if (meaning.empty()) return html_text(text);
  return "<abbr title='" + html_text(meaning) + "'>" + html_text(text) + "</abbr>";
}

std::string glossary_html() {
  std::string out = "<details class='words-used' id='words-used'><summary>The words of this report</summary>\n<dl>\n";
  for (const auto& [word, meaning] : kGlossary)
    out += "<div><dt>" + std::string(word) + "</dt><dd>" + html_text(meaning) + "</dd></div>\n";
  return out + "</dl>\n</details>\n";
}

}  // namespace contort
