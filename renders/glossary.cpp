#include "renders/glossary.h"

#include <utility>

#include "renders/html.h"

namespace contort {

namespace {

constexpr std::pair<std::string_view, std::string_view> kGlossary[] = {
    {"case", "One motion that was made and checked: a character, what it was told to do, and where. It is clean if no "
             "check failed."},
    {"failure", "One way to break a check, with the smallest case that does it. Its folder in the corpus is called a "
                "bucket."},
    {"cause", "What explains failures: an action that fails alone, several that fail only together, or what is around "
              "the figure. Found by playing each action of the smallest case alone."},
    {"severity", "From 0 to 100: how deep, how often, how visible and how easy to meet. It orders the causes."},
    {"minimal case", "The smallest case that still shows the failure: everything that it does not need was removed."},
    {"baseline", "The failures that were there before, such as those of last night. They are known and do not gate."},
    {"family", "Failures of one check in one place, such as a joint or two parts that run into each other."},
    {"margin", "How far something is from its limit. Below 0 the limit is broken; \"worst\" is where it is broken most."},
    {"needs", "The actions without which the failure does not happen: where to look for its cause."},
    {"comes with", "Other families that the smallest case shows as well. They are not failures of their own for that."},
    {"in the base", "What the other build of a comparison (contort fuzz --against) shows for the same case."},
    {"phase", "What was going on in the worst frame, such as an interrupt that had just cut in."},
    {"state", "new: nobody has looked at it. open: somebody looks after it. regressed: it was fixed and is back. "
              "fixed: gone. quarantined: it may fail until a day. flaky: not the same each time. waiting: found when "
              "the time was up, and not made small yet. unconfirmed: seen once, not the second time."},
    {"gating", "It makes an automatic build fail: new, regressed and waiting failures do."}};

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
  std::string out = "<details class='words-used' id='words-used'><summary>What the words mean</summary>\n<dl>\n";
  for (const auto& [word, meaning] : kGlossary)
    out += "<div><dt>" + std::string(word) + "</dt><dd>" + html_text(meaning) + "</dd></div>\n";
  return out + "</dl>\n</details>\n";
}

}  // namespace contort
