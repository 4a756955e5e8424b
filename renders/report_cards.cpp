#include "renders/report_cards.h"

#include <algorithm>
#include <map>
#include <set>

#include "renders/check_words.h"
#include "renders/glossary.h"
#include "renders/html.h"
#include "renders/thumb.h"
#include "renders/wording.h"

namespace contort {
namespace {

std::string chip(const std::string& state, bool gating) {
  static const std::set<std::string> kStyled = {"new", "regressed", "open", "quarantined", "fixed", "flaky"};
  const std::string look = kStyled.contains(state) ? " state-" + state : "";
  return "<span class='chip" + look + "'>" + html_text(state.empty() ? "no state" : state) +
         (gating ? "<span class='unseen'> (fails the build)</span>" : "") + "</span>";
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

std::string picture_html(const ReportRow& row, const std::string& path, std::string_view what,
                         const PageFiles& inside) {
  const std::string url = picture_url(path, inside);
  if (url.empty()) return "<p class='missing'>" + html_text(missing_text(row)) + "</p>\n";
  const std::string about = std::string(what) + ": " + row.check + ", " + row.subject + ", worst at " + worst_text(row);
  const std::string image = "<img src='" + url + "' loading='lazy'" + attribute("alt", about) +
                            attribute("data-missing", missing_text(row)) + ">";
  return "<div class='strip" + tile_class(row) + "'>" + (inside.empty() ? "<a href='" + url + "'>" + image + "</a>" : image) + "</div>\n";
}

std::string phase_fact(const ReportRow& row) {
  const std::string words = phase_text(row.phase);
  return words == row.phase ? words : row.phase + ": " + words;
}

// Leaves out the character, which the row already shows.
std::string without_figure(const Family& family) { return family.check + " " + family.subject; }

std::string also_fact(const ReportRow& row) {
  constexpr std::size_t kNamed = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, row.co_failures.size()); ++i)
    text += (i > 0 ? ", " : "") + without_figure(row.co_failures[i]);
  if (row.co_failures.size() > kNamed) text += ", and " + std::to_string(row.co_failures.size() - kNamed) + " more";
  return text;
}

std::string fact(std::string_view name, const std::string& value) {
  if (value.empty()) return "";
  return "<div><dt>" + term_html(name) + "</dt><dd>" + html_text(value) + "</dd></div>\n";
}

std::string details_html(std::string_view summary, const std::string& body) {
  return "<details><summary>" + std::string(summary) + "</summary>\n" + body + "</details>\n";
}

std::string open_html(const ReportRow& row, const PageFiles& inside) {
  return can_be_opened(row, inside) ? "<button type='button' class='open'>Look closer</button>\n" : "";
}

// The target of links to the case without scripts.
std::string place_of(const ReportRow& row) {
  return attribute("id", "case=" + row.key) + attribute("data-case", row.key);
}

std::string short_bucket_html(const ReportRow& row, const PageFiles& inside) {
  return "<section class='bucket'" + place_of(row) + ">\n<p class='summary'>" +
         html_text(short_text(row)) + "</p>\n" + open_html(row, inside) + command_html(row.replay_command) +
         "</section>\n";
}

std::string spec_title(const ReportRow& row) {
  if (is_shrunk(row)) return term_html("minimal case", "Minimal spec");
  return row.state == "waiting" ? "Spec as drawn (not shrunk yet)" : "Spec as drawn (not shrunk)";
}

std::string bucket_html(const ReportRow& row, Room& room, const PageFiles& inside) {
  std::string out = "<section class='bucket'" + place_of(row) + ">\n";
  out += picture_html(row, row.strip, "Film strip", inside);
  if (const std::string clip = html_url(row.clip); !clip.empty() && inside.empty())
    out += "<p><a class='moving' href='" + clip + "'>Moving, at half speed</a></p>\n";
  out += "<dl class='facts'>\n" + fact("meaning", row.meaning) + fact("measured", value_text(row)) +
         fact("worst at", worst_text(row)) +
         fact("violated in", violated_text(row)) + fact("phase", phase_fact(row)) + fact("cause", row.cause) +
         fact(is_shrunk(row) ? "needs" : "contains", row.needs) + fact("comes with", also_fact(row)) +
         fact("in the base", row.since_base) + fact("it printed", row.printed) + fact("status", row.note) + fact("bucket", row.bucket) + "</dl>\n";
  out += open_html(row, inside) + command_html(row.replay_command);
  if (row.spec_json.empty() || row.spec_json.size() > room.spec_bytes) return out + "</section>\n";
  room.spec_bytes -= row.spec_json.size();
  out += details_html(spec_title(row), "<pre tabindex='0'><code>" + html_lines(row.spec_json) + "</code></pre>\n");
  return out + "</section>\n";
}

// Joins words with spaces.
std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string card_head(const FamilyCard& card) {
  const ReportRow& row = *card.rows.front();
  std::string chips;
  for (const auto& [state, gating] : chips_of(card)) chips += chip(state, gating);
  return "<div class='head'>\n<h3><span class='plain-name'>" + html_text(check_title(row.check)) +
         "</span> <span class='check'>" + html_text(row.check) + "</span> <span class='subject'>" +
         html_text(row.subject) + "</span></h3>\n<p class='summary'>" + chips + " <span>" + html_text(count_of(card)) +
         "</span></p>\n</div>\n";
}

std::string any_bucket_html(const ReportRow& row, Room& room, const PageFiles& inside) {
  const std::string html = room.buckets > 0 ? bucket_html(row, room, inside) : short_bucket_html(row, inside);
  room.buckets -= room.buckets > 0 ? 1 : 0;
  room.take(html.size());
  return html;
}

// The buckets of a card after the first. page.js adds rows that are in other files; `data-more` has the number of the
// card.
std::string more_html(const FamilyCard& card, LateCard& late, Room& room, const PageFiles& inside) {
  std::string shown;
  for (std::size_t i = 1; i < card.rows.size(); ++i)
    if (room.bytes > 0)
      shown += any_bucket_html(*card.rows[i], room, inside);
    else
      late.rows.push_back(card.rows[i]);
  const auto more = static_cast<std::int64_t>(card.rows.size()) - 1;
  if (more == 0) return "";
  std::string which;
  if (!late.rows.empty()) {
    late.begun = true;
    which = attribute("data-more", std::to_string(late.number));
    shown += "<p class='rest'>" + html_text(count_text(static_cast<std::int64_t>(late.rows.size()))) +
             " of them are in <a href='more.html'>the plain list</a>.</p>\n";
  }
  return "<details" + which + "><summary>" + html_text(counted(more, "more failure", "more failures")) + "</summary>\n" +
         shown + "</details>\n";
}

}  // namespace

bool FamilyCard::gating() const {
  return std::any_of(rows.begin(), rows.end(), [](const ReportRow* row) { return row->gating; });
}

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

std::string states_of(const FamilyCard& card) {
  std::set<std::string> states;
  for (const ReportRow* row : card.rows) states.insert(row->state);
  return joined(states);
}

std::string parts_of(const ReportRow& row) {
  constexpr std::string_view kPairSeparator = " ~ ";
  std::string_view rest = row.subject;
  if (const std::string prefix = row.character + ": "; rest.starts_with(prefix)) rest.remove_prefix(prefix.size());
  std::set<std::string> parts;
  while (!rest.empty()) {
    const std::size_t cut = std::min(rest.find(kPairSeparator), rest.size());
    const std::string_view name = rest.substr(0, cut);
    parts.emplace(name.substr(0, name.find_first_of("/ ")));
    rest.remove_prefix(std::min(cut + kPairSeparator.size(), rest.size()));
  }
  return joined(parts);
}

std::string phases_of(const FamilyCard& card) {
  std::set<std::string> phases;
  for (const ReportRow* row : card.rows)
    if (!row->phase.empty()) phases.insert(row->phase);
  return joined(phases);
}

std::vector<std::pair<std::string, bool>> chips_of(const FamilyCard& card) {
  std::vector<std::pair<std::string, bool>> chips;
  std::set<std::string> shown;
  for (const ReportRow* row : card.rows)
    if (shown.insert(row->state).second) chips.emplace_back(row->state, row->gating);
  return chips;
}

std::string count_of(const FamilyCard& card) {
  std::int64_t cases = 0;
  for (const ReportRow* row : card.rows) cases = std::max(cases, row->cases_seen);
  const auto buckets = static_cast<std::int64_t>(card.rows.size());
  const std::string of_cases = cases > 0 ? counted(cases, "case", "cases") : "no case of a recorded run showed it";
  return of_cases + (buckets > 1 ? ", " + counted(buckets, "failure", "failures") : "");
}

std::string short_text(const ReportRow& row) {
  const std::string phase = phase_text(row.phase);
  const std::string value = value_text(row);
  return value + (value.empty() ? "" : "; ") + "worst at " + worst_text(row) + (phase.empty() ? "" : ", " + phase) + (is_shrunk(row) ? "; needs " : "; contains ") + row.needs;
}

bool can_be_opened(const ReportRow& row, const PageFiles& inside) {
  return row.has_motion && !row.key.empty() && (inside.empty() || inside.contains("cases/" + row.key + ".json"));
}

std::string command_html(const std::string& command) {
  if (command.empty()) return "";
  return "<div class='command'><code>" + html_text(command) +
         "</code><button type='button' class='copy' aria-label='Copy the replay command'>Copy</button></div>\n";
}

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "='" + html_text(value) + "'";
}

std::string card_html(const FamilyCard& card, LateCard& late, Room& room, const PageFiles& inside) {
  const ReportRow& row = *card.rows.front();
  const std::string look = card.gating() ? "card gating" : "card";
  const std::string head = "<article tabindex='-1'" + attribute("class", look) + attribute("data-check", row.check) +
                           attribute("data-character", row.character) + attribute("data-parts", parts_of(row)) +
                           attribute("data-phase", phases_of(card)) + attribute("data-state", states_of(card)) + ">\n" +
                           card_head(card);
  room.take(head.size());
  const std::string first = any_bucket_html(row, room, inside);
  return head + first + more_html(card, late, room, inside) + "</article>\n";
}

}  // namespace contort
