#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "generator/core/hash.h"
#include "generator/core/base64.h"
#include "renders/html.h"
#include "renders/page_files.h"
#include "renders/report.h"
#include "renders/search_html.h"
#include "renders/wording.h"

namespace contort {
namespace {

// One attribute with its leading space.
std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "='" + html_text(value) + "'";
}

// Rows of one family, in the order of the model.
struct FamilyCard {
  std::vector<const ReportRow*> rows;
  bool gating() const {
    return std::any_of(rows.begin(), rows.end(), [](const ReportRow* row) { return row->gating; });
  }
};

std::vector<FamilyCard> cards_of(const ReportModel& model) {
  std::vector<FamilyCard> cards;
  std::map<std::string, std::size_t> card_of_family;
  for (const ReportRow& row : model.rows) {
    const auto [at, is_new] = card_of_family.try_emplace(row.family, cards.size());
    if (is_new) cards.emplace_back();
    cards[at->second].rows.push_back(&row);
  }
  std::stable_partition(cards.begin(), cards.end(), [](const FamilyCard& card) { return card.gating(); });
  return cards;
}

// ---- verdict

struct Verdict {
  std::string look;  // class: bad, good, idle
  std::string text;
  std::string detail;
};

// "3 new, 1 regressed"
std::string states_text(const std::map<std::string, std::int64_t>& states) {
  std::string text;
  for (const auto& [state, count] : states)
    text += (text.empty() ? "" : ", ") + count_text(count) + " " + (state.empty() ? "without state" : state);
  return text;
}

Verdict verdict_of(const ReportModel& model) {
  std::map<std::string, std::int64_t> gating, known;
  std::set<std::string> gating_families;
  for (const ReportRow& row : model.rows) {
    ++(row.gating ? gating : known)[row.state];
    if (row.gating) gating_families.insert(row.family);
  }
  std::int64_t count = 0;
  for (const auto& [state, n] : gating) count += n;
  const std::string others = known.empty() ? "" : "Known, not gating: " + states_text(known) + ".";
  if (count == 0 && model.cases == 0 && model.rows.empty())
    return {"idle", "Nothing was tested", "No case was run, so this says nothing about the animation."};
  if (count == 0) return {"good", "Nothing gating", others.empty() ? "No failure is known." : others};
  const bool all_new = gating.size() == 1 && gating.contains("new");
  std::string detail = "In " + counted(static_cast<std::int64_t>(gating_families.size()), "family", "families");
  if (!all_new) detail += ": " + states_text(gating);
  const std::string kind = all_new ? "new" : "gating";
  return {"bad", counted(count, kind + " failure", kind + " failures"), detail + ". " + others};
}

std::string number_item(const std::string& value, std::string_view name) {
  return "<div><dt>" + std::string(name) + "</dt><dd>" + html_text(value) + "</dd></div>\n";
}

std::string verdict_html(const ReportModel& model, const Verdict& verdict) {
  std::string out = "<header class='verdict " + verdict.look + "'>\n<div class='page'>\n<p class='title'>" +
                    html_text(model.title) + "</p>\n<h1>" + html_text(verdict.text) + "</h1>\n<p class='detail'>" +
                    html_text(verdict.detail) + "</p>\n<dl class='numbers'>\n";
  out += number_item(count_text(model.cases), "cases") + number_item(count_text(model.frames), "frames") +
         number_item(count_text(model.findings), "findings") + number_item(count_text(model.families), "families") +
         number_item(count_text(model.buckets), "buckets");
  if (!model.elapsed.empty()) out += number_item(model.elapsed, "elapsed");
  return out + "</dl>\n</div>\n</header>\n";
}

// ---- cards

std::string chip(const std::string& state, bool gating) {
  static const std::set<std::string> kStyled = {"new", "regressed", "open", "quarantined", "fixed", "flaky"};
  const std::string look = kStyled.contains(state) ? " state-" + state : "";
  return "<span class='chip" + look + "'>" + html_text(state.empty() ? "no state" : state) +
         (gating ? "<span class='unseen'> (gating)</span>" : "") + "</span>";
}

std::string worst_text(const ReportRow& row) {
  const std::string time = time_text(row.worst_frame, row.rate_hz);
  return "frame " + std::to_string(row.worst_frame) + (time.empty() ? "" : ", " + time);
}

std::string violated_text(const ReportRow& row) {
  if (row.first_frame == row.last_frame) return "";
  return "frames " + std::to_string(row.first_frame) + "\xE2\x80\x93" + std::to_string(row.last_frame);
}

std::string missing_text(const ReportRow& row) {
  return row.has_motion ? "picture missing: " + row.replay_command
                        : "no motion to show: the generator does not come to its end";
}

// Where the page finds a picture: beside it, or in itself.
std::string picture_url(const std::string& path, const PageFiles& inside) {
  const auto file = inside.find(path);
  if (file == inside.end()) return html_url(path);
  return "data:image/png;base64," + to_base64(std::as_bytes(std::span(file->second)));
}

std::string picture_html(const ReportRow& row, const std::string& path, std::string_view what,
                         const PageFiles& inside) {
  const std::string url = picture_url(path, inside);
  if (url.empty()) return "<p class='missing'>" + html_text(missing_text(row)) + "</p>\n";
  const std::string about = std::string(what) + ": " + row.check + ", " + row.subject + ", worst at " + worst_text(row);
  const std::string image = "<img src='" + url + "' loading='lazy'" + attribute("alt", about) +
                            attribute("data-missing", missing_text(row)) + ">";
  return "<div class='strip'>" + (inside.empty() ? "<a href='" + url + "'>" + image + "</a>" : image) + "</div>\n";
}

std::string fact(std::string_view name, const std::string& value) {
  if (value.empty()) return "";
  return "<div><dt>" + std::string(name) + "</dt><dd>" + html_text(value) + "</dd></div>\n";
}

std::string command_html(const std::string& command) {
  if (command.empty()) return "";
  return "<div class='command'><code>" + html_text(command) +
         "</code><button type='button' class='copy' aria-label='Copy the replay command'>Copy</button></div>\n";
}

std::string details_html(std::string_view summary, const std::string& body) {
  return "<details><summary>" + std::string(summary) + "</summary>\n" + body + "</details>\n";
}

// A page stays below a megabyte with a thousand buckets: those that come later, which gate less and are less deep, have
// no picture before they are opened, and specs are left to the viewer.
struct Room {
  explicit Room(std::size_t rows) : spec_bytes(rows <= 250 ? 400'000 : 0) {}
  std::size_t buckets = 80;  // that may still be shown with everything
  std::size_t spec_bytes;    // that they may still write out
};

std::string open_html(const ReportRow& row, const PageFiles& inside) {
  const bool there = row.has_motion && (inside.empty() || inside.contains("cases/" + row.key + ".json"));
  return there && !row.key.empty() ? "<button type='button' class='open'>Look closer</button>\n" : "";
}

std::string short_bucket_html(const ReportRow& row, const PageFiles& inside) {
  return "<section class='bucket'" + attribute("data-case", row.key) + ">\n<p class='summary'>worst " +
         html_text(margin_text(row.worst_margin, row.unit) + " at " + worst_text(row) + "; needs " +
                   needs_text(row.features)) +
         "</p>\n" + open_html(row, inside) + command_html(row.replay_command) + "</section>\n";
}

std::string bucket_html(const ReportRow& row, Room& room, const PageFiles& inside) {
  std::string out = "<section class='bucket'" + attribute("data-case", row.key) + ">\n";
  out += picture_html(row, row.strip, "Film strip", inside);
  if (const std::string clip = html_url(row.clip); !clip.empty() && inside.empty())
    out += "<p><a class='moving' href='" + clip + "'>Moving, at half speed</a></p>\n";
  out += "<dl class='facts'>\n" + fact("meaning", row.meaning) +
         fact("worst margin", margin_text(row.worst_margin, row.unit)) + fact("worst at", worst_text(row)) +
         fact("violated in", violated_text(row)) + fact("needs", needs_text(row.features)) +
         fact("known", row.note) + fact("bucket", row.bucket) + "</dl>\n";
  out += open_html(row, inside) + command_html(row.replay_command);
  if (row.spec_json.empty() || row.spec_json.size() > room.spec_bytes) return out + "</section>\n";
  room.spec_bytes -= row.spec_json.size();
  out += details_html("Minimal spec", "<pre tabindex='0'><code>" + html_lines(row.spec_json) + "</code></pre>\n");
  return out + "</section>\n";
}

std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string states_of(const FamilyCard& card) {
  std::set<std::string> states;
  for (const ReportRow* row : card.rows) states.insert(row->state);
  return joined(states);
}

// Slots that a subject names: "arm_left torso" of "human: arm_left/forearm ~ torso/chest".
std::string parts_of(const ReportRow& row) {
  constexpr std::string_view kBetween = " ~ ";
  std::string_view rest = row.subject;
  if (const std::string prefix = row.character + ": "; rest.starts_with(prefix)) rest.remove_prefix(prefix.size());
  std::set<std::string> parts;
  while (!rest.empty()) {
    const std::size_t cut = std::min(rest.find(kBetween), rest.size());
    const std::string_view name = rest.substr(0, cut);
    parts.emplace(name.substr(0, name.find_first_of("/ ")));
    rest.remove_prefix(std::min(cut + kBetween.size(), rest.size()));
  }
  return joined(parts);
}

std::string card_head(const FamilyCard& card) {
  const ReportRow& row = *card.rows.front();
  std::int64_t cases = 0;
  std::string chips;
  std::set<std::string> shown;
  for (const ReportRow* r : card.rows) {
    cases = std::max(cases, r->cases_seen);
    if (shown.insert(r->state).second) chips += chip(r->state, r->gating);
  }
  const auto buckets = static_cast<std::int64_t>(card.rows.size());
  return "<div class='head'>\n<h3><span class='check'>" + html_text(row.check) + "</span> <span class='subject'>" +
         html_text(row.subject) + "</span></h3>\n<p class='summary'>" + chips + " <span>" +
         html_text(counted(cases, "case", "cases")) +
         (buckets > 1 ? ", " + html_text(counted(buckets, "bucket", "buckets")) : "") + "</span></p>\n</div>\n";
}

std::string card_html(const FamilyCard& card, Room& room, const PageFiles& inside) {
  const ReportRow& row = *card.rows.front();
  const std::string look = card.gating() ? "card gating" : "card";
  std::string out = "<article tabindex='-1'" + attribute("class", look) + attribute("data-check", row.check) +
                    attribute("data-character", row.character) + attribute("data-parts", parts_of(row)) +
                    attribute("data-state", states_of(card)) + ">\n" + card_head(card);
  std::string others;
  for (const ReportRow* bucket : card.rows) {
    (bucket == &row ? out : others) +=
        room.buckets > 0 ? bucket_html(*bucket, room, inside) : short_bucket_html(*bucket, inside);
    room.buckets -= room.buckets > 0 ? 1 : 0;
  }
  const auto more = static_cast<std::int64_t>(card.rows.size()) - 1;
  if (more > 0) out += details_html(html_text(counted(more, "more bucket", "more buckets")), others);
  return out + "</article>\n";
}

// ---- the rest of the page

// page.js fills the choices from the cards.
std::string filter_html() {
  std::string out =
      "<form class='filter' role='search'>\n<label class='words'><span>Filter</span><input type='search' id='words' "
      "autocomplete='off' spellcheck='false' placeholder='elbow, state:new, walk'></label>\n";
  for (const auto& [id, name] : {std::pair("check", "Check"), std::pair("character", "Character"),
                                 std::pair("part", "Part"), std::pair("state", "State")})
    out += "<label><span>" + std::string(name) + "</span><select id='" + id + "'></select></label>\n";
  return out + "<output id='shown' aria-live='polite'></output>\n</form>\n";
}

std::string failures_html(const ReportModel& model, const PageFiles& inside) {
  std::string out = "<section id='failures'>\n<h2>Failures</h2>\n";
  if (model.rows.empty()) return out + "<p class='none'>None.</p>\n</section>\n";
  out += filter_html();
  Room room(model.rows.size());
  for (const FamilyCard& card : cards_of(model)) out += card_html(card, room, inside);
  return out + "<p class='none' id='no-match' hidden>Nothing matches the filter.</p>\n</section>\n";
}

std::string bar_html(std::int64_t count, std::int64_t largest) {
  const double share = largest > 0 ? static_cast<double>(count) / static_cast<double>(largest) : 0.0;
  char width[32];
  std::snprintf(width, sizeof width, "%.2f", 100.0 * share);
  return "<svg class='bar' viewBox='0 0 100 1' preserveAspectRatio='none' aria-hidden='true'><rect height='1'" +
         attribute("width", width) + "/></svg>";
}

std::string pairs_html(const ReportModel& model) {
  if (model.pairs_possible == 0) return "";
  std::int64_t seen = 0;
  for (const auto& [name, count] : model.tested) seen += name.rfind("pair ", 0) == 0 && count > 0;
  char share[32];
  std::snprintf(share, sizeof share, "%.0f %%",
                100.0 * static_cast<double>(seen) / static_cast<double>(model.pairs_possible));
  return "<p>Pairs of actions at the same time on one part: " + html_text(count_text(seen)) + " of " +
         html_text(count_text(model.pairs_possible)) + " occurred (" + share + ").</p>\n";
}

std::string tested_html(const ReportModel& model) {
  if (model.tested.empty()) return "";
  std::int64_t largest = 0;
  for (const auto& [name, count] : model.tested) largest = std::max(largest, count);
  std::string out = "<section id='tested'>\n<h2>What was tested</h2>\n" + pairs_html(model) +
                    "<table>\n<thead><tr><th scope='col'>part of a case</th>"
                    "<th scope='col'>times</th><th></th></tr></thead>\n<tbody>\n";
  for (const auto& [name, count] : model.tested)
    out += (count == 0 ? "<tr class='never'><th scope='row'>" : "<tr><th scope='row'>") + html_text(name) +
           "</th><td>" + html_text(count_text(count)) + "</td><td>" + bar_html(count, largest) + "</td></tr>\n";
  return out + "</tbody>\n</table>\n</section>\n";
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
  // The nonce is made from the content: an injected script, if escaping ever failed, would have to name the hash of the
  // page that it is part of.
  const std::string by_nonce = "'nonce-" + nonce + "'", here = attribute("nonce", nonce);
  return "<!doctype html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n"
         "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; img-src 'self' file: data:; "
         "style-src " +
         by_nonce + "; script-src " + by_nonce +
         "; base-uri 'none'; form-action 'none'\">\n"
         "<meta name='viewport' content='width=device-width, initial-scale=1'>\n"
         "<meta name='color-scheme' content='light dark'>\n<meta name='referrer' content='no-referrer'>\n<title>" +
         html_text(verdict.text + " \xE2\x80\x93 " + model.title) + "</title>\n<link rel='icon' href='data:,'>\n" +
         "<style" + here + ">\n" + text_of("page.css") + "</style>\n" + "<script" + here + ">\n" + text_of("page.js") +
         "</script>\n</head>\n";
}

// A script without what an HTML parser would see in it; in JavaScript's strings both spellings are the same.
std::string inline_script(std::string text) {
  for (const auto& [seen, written] : {std::pair("</script", "<\\/script"), std::pair("<!--", "<\\!--")})
    for (std::size_t at = text.find(seen); at != text.npos; at = text.find(seen, at))
      text.replace(at, std::string_view(seen).size(), written);
  return text;
}

// The viewer and the cases, for page.js to find them.
std::string inside_html(const PageFiles& inside, const std::string& nonce) {
  const std::string here = attribute("nonce", nonce);
  std::string out;
  for (const auto& [path, text] : inside) {
    const std::filesystem::path name(path);
    if (name.extension() == ".css") out += "<style" + here + ">\n" + text + "</style>\n";
    if (name.extension() == ".js") out += "<script" + here + ">\n" + inline_script(text) + "</script>\n";
    if (name.extension() == ".json")
      out += "<script type='application/json'" + attribute("id", "case-" + name.stem().string()) + here + ">" + text +
             "</script>\n";
  }
  return out;
}

}  // namespace

std::string report_html(const ReportModel& model, const PageFiles& inside) {
  const Verdict verdict = verdict_of(model);
  const std::string nonce = content_id(report_json(model));
  return head_html(model, verdict, nonce) +
         "<body>\n<a class='skip' href='#failures'>Skip to the failures</a>\n" + verdict_html(model, verdict) +
         "<main class='page'>\n" + failures_html(model, inside) + search_html(model.search) + tested_html(model) +
         "</main>\n" + footer_html(model, !inside.empty()) + inside_html(inside, nonce) + "</body>\n</html>\n";
}

}  // namespace contort
