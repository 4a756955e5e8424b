#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "model/core/hash.h"
#include "renders/glossary.h"
#include "renders/html.h"
#include "renders/page_files.h"
#include "renders/report.h"
#include "renders/causes_html.h"
#include "renders/check_table_html.h"
#include "renders/report_cards.h"
#include "renders/report_rest.h"
#include "renders/search_html.h"
#include "renders/tested_html.h"
#include "renders/wording.h"

namespace contort {
namespace {

// ---- verdict

struct Verdict {
  std::string look;  // style class: bad, good, idle
  std::string text;
  std::string detail;
};

// Text such as "3 new, 1 regressed".
std::string states_text(const std::map<std::string, std::int64_t>& states) {
  std::string text;
  for (const auto& [state, count] : states)
    text += (text.empty() ? "" : ", ") + count_text(count) + " " + (state.empty() ? "without state" : state);
  return text;
}

std::string others_text(const std::map<std::string, std::int64_t>& known, std::int64_t unsettled) {
  const std::string text = known.empty() ? "" : "These do not fail the build: " + states_text(known) + ".";
  return text + (text.empty() || unsettled == 0 ? "" : " ") + unsettled_text(unsettled);
}

std::int64_t gating_causes(const ReportModel& model, const std::set<std::string>& gating_buckets) {
  return std::ranges::count_if(model.causes, [&](const ReportCause& cause) {
    return std::ranges::any_of(cause.buckets, [&](const std::string& id) { return gating_buckets.contains(id); });
  });
}

Verdict verdict_of(const ReportModel& model) {
  std::map<std::string, std::int64_t> gating, known;
  std::set<std::string> gating_families, gating_buckets;
  for (const ReportRow& row : model.rows) {
    ++(row.gating ? gating : known)[row.state];
    if (row.gating) gating_families.insert(row.family), gating_buckets.insert(row.bucket);
  }
  std::int64_t count = 0;
  for (const auto& [state, n] : gating) count += n;
  const std::string others = others_text(known, model.unsettled);
  if (count == 0 && model.cases == 0 && model.rows.empty())
    return {"idle", "Nothing was tested", "No case was run, so this says nothing about the animation."};
  if (count == 0 && model.cases == model.refused && model.rows.empty())
    return {"idle", "Nothing was tested",
            "The generator refused every request, so this says nothing about the animation."};
  if (count == 0 && model.unsettled > 0) return {"idle", "The run was stopped before it was done", others};
  if (count == 0) return {"good", "Nothing fails the build", others.empty() ? "No failure is known." : others};
  const bool all_new = gating.size() == 1 && gating.contains("new");
  const std::int64_t causes = gating_causes(model, gating_buckets);
  std::string detail = causes > 0 ? "By " + counted(causes, "cause", "causes")
                                  : "In " + counted(std::ssize(gating_families), "kind of failure", "kinds of failure");
  const std::string text = all_new ? counted(count, "new failure", "new failures") : gate_text(model);
  gating.erase("waiting");  // the title counts them
  if (!all_new && !gating.empty()) detail += ": " + states_text(gating);
  return {"bad", text, detail + ". " + others};
}

// `singular` is the word of the glossary that explains the name.
std::string number_item(const std::string& value, std::string_view name, std::string_view singular = {}) {
  return "<div><dt>" + term_html(singular, name) + "</dt><dd>" + html_text(value) + "</dd></div>\n";
}

// Failures that need no attention now are counted separately, if there are any.
std::string failure_items(const RowCounts& counts) {
  std::string out = number_item(count_text(counts.failures), "failures", "failure");
  if (counts.fixed > 0) out += number_item(count_text(counts.fixed), "fixed", "state");
  if (counts.waiting > 0) out += number_item(count_text(counts.waiting), "waiting", "state");
  if (counts.unconfirmed > 0) out += number_item(count_text(counts.unconfirmed), "unconfirmed", "state");
  return out;
}

std::string verdict_html(const ReportModel& model, const Verdict& verdict) {
  std::string out = "<header class='verdict " + verdict.look + "'>\n<div class='page'>\n<p class='title'>" +
                    html_text(model.title) + "</p>\n<h1>" + html_text(verdict.text) + "</h1>\n<p class='detail'>" +
                    html_text(verdict.detail) + "</p>\n<dl class='numbers'>\n";
  out += number_item(count_text(model.cases), "cases", "case");
  if (model.search.cases > model.refused)
    out += number_item(clean_share(model.search.cases - model.refused, model.search.failing), "of them clean");
  out += number_item(count_text(std::ssize(model.causes)), "causes", "cause") +
         failure_items(row_counts(model)) + number_item(count_text(model.frames), "frames");
  if (!model.elapsed.empty()) out += number_item(model.elapsed, "elapsed");
  return out + "</dl>\n</div>\n</header>\n";
}

// ---- the rest of the page

// page.js fills in the choices from the cards.
std::string filter_html() {
  std::string out =
      "<form class='filter' role='search'>\n<label class='words'><span>Filter</span><input type='search' id='words' "
      "autocomplete='off' spellcheck='false' placeholder='elbow, state:new, walk'></label>\n";
  for (const auto& [id, name] : {std::pair("check", "Check"), std::pair("character", "Character"),
                                 std::pair("part", "Part"), std::pair("phase", "Phase"), std::pair("state", "State")})
    out += "<label><span>" + std::string(name) + "</span><select id='" + id + "'></select></label>\n";
  return out + "<output id='shown' aria-live='polite'></output>\n</form>\n";
}

// Returns the cards that fit; the rest goes to `late`.
std::string failures_html(const std::vector<FamilyCard>& cards, const PageFiles& inside, Room room,
                          std::vector<LateCard>& late) {
  std::string shown;
  std::int64_t elsewhere = 0;
  for (std::size_t i = 0; i < cards.size(); ++i) {
    LateCard rest{static_cast<int>(i), &cards[i], {}, false};
    if (room.bytes > 0)
      shown += card_html(cards[i], rest, room, inside);
    else
      rest.rows = cards[i].rows;
    elsewhere += static_cast<std::int64_t>(rest.rows.size());
    if (!rest.rows.empty()) late.push_back(std::move(rest));
  }
  const std::string parts = elsewhere == 0 ? "" : attribute("data-row-files", std::to_string(row_script_count(late)));
  std::string out = "<section id='failures'" + parts + ">\n<h2>Failures</h2>\n";
  if (cards.empty()) return out + "<p class='none'>None.</p>\n</section>\n";
  out += filter_html();
  if (cards.size() > 2)
    out += "<p class='order'>Failures that nobody has looked at come first. They are sorted for variety, so that the "
           "first few show most kinds.</p>\n";
  out += shown;
  if (elsewhere > 0)
    out += "<p class='rest' id='rest'>" + html_text(counted(elsewhere, "more failure", "more failures")) +
           " in <a href='more.html'>the plain list</a>.</p>\n";
  return out + "<p class='none' id='no-match' hidden>Nothing matches the filter.</p>\n</section>\n";
}

std::string footer_html(const ReportModel& model, bool alone) {
  static constexpr char kKeys[] =
      " <span class='keys'>Keys: <kbd>/</kbd> filter, <kbd>j</kbd> <kbd>k</kbd> next and previous failure, "
      "<kbd>Enter</kbd> look closer.</span>";
  const std::string json = alone ? "." : "; the same numbers are in <a href='report.json'>report.json</a>.";
  return "<footer class='page'><p>Made by contort" + json +
         std::string(model.rows.empty() ? "" : kKeys) + "</p></footer>\n";
}

std::string text_of(std::string_view name) {
  for (const StockFile& file : page_files())
    if (file.name == name) return std::string(file.text);
  return "";
}

std::string head_html(const ReportModel& model, const Verdict& verdict, const std::string& nonce) {
  // The nonce is a hash of the content. If escaping ever failed, an injected script would have to contain the hash of
  // the page of which it is a part.
  const std::string by_nonce = "'nonce-" + nonce + "'", here = attribute("nonce", nonce);
  return "<!doctype html>\n<html lang='en'" + std::string(model.has_engine ? " data-engine" : "") + ">\n<head>\n<meta charset='utf-8'>\n"
         "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; img-src 'self' file: data:; "
         "style-src " +
         by_nonce + "; script-src " + by_nonce + (model.has_engine ? " 'wasm-unsafe-eval'" : "") +
         "; base-uri 'none'; form-action 'none'\">\n"
         "<meta name='viewport' content='width=device-width, initial-scale=1'>\n"
         "<meta name='color-scheme' content='light dark'>\n<meta name='referrer' content='no-referrer'>\n<title>" +
         html_text(verdict.text + " \xE2\x80\x93 " + model.title) + "</title>\n<link rel='icon' href='data:,'>\n" +
         "<style" + here + ">\n" + text_of("page.css") + "</style>\n" + "<script" + here + ">\n" + text_of("rows.js") + text_of("page.js") +
         "</script>\n</head>\n";
}

// Replaces character sequences that an HTML parser would interpret inside a script; in JavaScript strings both
// spellings are the same.
std::string inline_script(std::string text) {
  for (const auto& [seen, written] : {std::pair("</script", "<\\/script"), std::pair("<!--", "<\\!--")})
    for (std::size_t at = text.find(seen); at != text.npos; at = text.find(seen, at))
      text.replace(at, std::string_view(seen).size(), written);
  return text;
}

// The viewer, the cases and the cameras of strips, in a form that page.js reads.
std::string inside_html(const PageFiles& inside, const std::string& nonce) {
  const std::string here = attribute("nonce", nonce);
  std::string out;
  for (const auto& [path, text] : inside) {
    const std::filesystem::path name(path);
    if (name.extension() == ".css") out += "<style" + here + ">\n" + text + "</style>\n";
    if (name.extension() == ".js") out += "<script" + here + ">\n" + inline_script(text) + "</script>\n";
    if (name.extension() != ".json") continue;
    const std::string kind = name.parent_path() == "strips" ? "strip-" : "case-";
    out += "<script type='application/json'" + attribute("id", kind + name.stem().string()) + here + ">" + text +
           "</script>\n";
  }
  return out;
}

}  // namespace

namespace {

// A page of a megabyte opens slowly, over a network and in a mail's preview.
constexpr std::size_t kMostBytes = 900'000, kMostCardBytes = 600'000, kLeastCardBytes = 100'000;
// Reports with at most this many rows may use all of it, and have all specs on the page.
constexpr std::size_t kFewRows = 250;

Room room_for(const ReportModel& model, std::size_t others, bool alone) {
  const bool few = model.rows.size() <= kFewRows;
  Room room;
  room.spec_bytes = few ? 400'000 : 0;
  room.bytes = std::clamp(kMostBytes - std::min(kMostBytes, others), kLeastCardBytes, few ? kMostBytes : kMostCardBytes);
  if (alone) room.bytes = static_cast<std::size_t>(-1);  // There are no other files, and mail accepts more.
  return room;
}

std::string index_html(const ReportModel& model, const std::vector<FamilyCard>& cards, const PageFiles& inside,
                       std::vector<LateCard>& late) {
  const Verdict verdict = verdict_of(model);
  const std::string nonce = content_id(report_json(model));
  const std::string head = head_html(model, verdict, nonce) +
                           "<body>\n<a class='skip' href='#failures'>Skip to the failures</a>\n" +
                           verdict_html(model, verdict) + "<main class='page'>\n" + causes_html(model, inside) +
                           check_table_html(model);
  const std::string tail = search_html(model.search) + tested_html(model) + glossary_html() + "</main>\n" +
                           footer_html(model, !inside.empty()) + inside_html(inside, nonce) + "</body>\n</html>\n";
  const Room room = room_for(model, head.size() + tail.size(), !inside.empty());
  return head + failures_html(cards, inside, room, late) + tail;
}

}  // namespace

std::string report_html(const ReportModel& model, const PageFiles& inside) {
  std::vector<LateCard> late;
  return index_html(model, cards_of(model), inside, late);
}

PageFiles report_pages(const ReportModel& model) {
  const std::vector<FamilyCard> cards = cards_of(model);
  std::vector<LateCard> late;
  PageFiles pages;
  pages["index.html"] = index_html(model, cards, {}, late);
  if (late.empty()) return pages;
  pages["more.html"] = plain_list_html(model.title, late, text_of("page.css"));
  for (auto& [path, script] : row_scripts(late)) pages[path] = std::move(script);
  return pages;
}

}  // namespace contort
