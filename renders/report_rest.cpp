#include "renders/report_rest.h"

#include <algorithm>
#include <filesystem>

#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/json_fields.h"
#include "renders/check_words.h"
#include "renders/html.h"
#include "renders/wording.h"

namespace contort {
namespace {

using json_fields::Json;

constexpr std::size_t kRowsPerScript = 500;  // about a quarter of a megabyte
constexpr char kCall[] = "contortRows(";
constexpr char kMark[] = "<!doctype html>\n<!-- contort: the rest of a report -->\n";

std::string script_name(std::size_t number) { return "rows/part-" + std::to_string(number) + ".js"; }

Json bucket_json(const ReportRow& row) {
  return {{"key", row.key},
          {"text", short_text(row)},
          {"open", can_be_opened(row, {})},
          {"command", row.replay_command}};
}

// The texts are the same as on the page; page.js only inserts them.
Json card_json(const LateCard& late) {
  Json json = {{"card", late.number}, {"buckets", Json::array()}};
  if (late.begun) return json;
  const ReportRow& row = *late.card->rows.front();
  json["title"] = check_title(row.check), json["check"] = row.check, json["subject"] = row.subject, json["character"] = row.character;
  json["parts"] = parts_of(row), json["phase"] = phases_of(*late.card), json["state"] = states_of(*late.card);
  json["gating"] = late.card->gating(), json["count"] = count_of(*late.card);
  for (const auto& [state, gating] : chips_of(*late.card)) json["chips"].push_back(Json::array({state, gating}));
  const auto more = static_cast<std::int64_t>(late.rows.size()) - 1;
  if (more > 0) json["more"] = counted(more, "more failure", "more failures");
  return json;
}

std::string script_of(const Json& cards) {
  return kCall + cards.dump(-1, ' ', true, Json::error_handler_t::replace) + ");\n";
}

std::size_t rows_of(const std::vector<LateCard>& late) {
  std::size_t rows = 0;
  for (const LateCard& card : late) rows += card.rows.size();
  return rows;
}

std::string plain_row(const LateCard& late, const ReportRow& row) {
  return "<tr><td>" + html_text(row.state) + "</td><th scope='row'>" + html_text(late.card->rows.front()->check) + " " +
         html_text(row.subject) + "</th><td>" + html_text(short_text(row)) + "</td><td><code>" +
         html_text(row.replay_command) + "</code></td></tr>\n";
}

}  // namespace

std::size_t row_script_count(const std::vector<LateCard>& late) {
  return (rows_of(late) + kRowsPerScript - 1) / kRowsPerScript;
}

std::vector<std::pair<std::string, std::string>> row_scripts(const std::vector<LateCard>& late) {
  std::vector<std::pair<std::string, std::string>> scripts;
  Json cards = Json::array();
  std::size_t rows = 0;
  const auto close = [&] {
    scripts.emplace_back(script_name(scripts.size() + 1), script_of(cards));
    cards = Json::array(), rows = 0;
  };
  for (const LateCard& one : late) {
    if (rows == kRowsPerScript) close();
    cards.push_back(card_json(one));
    for (const ReportRow* row : one.rows) {
      if (rows == kRowsPerScript) {  // the card continues in the next file
        close();
        cards.push_back({{"card", one.number}, {"buckets", Json::array()}});
      }
      cards.back()["buckets"].push_back(bucket_json(*row));
      ++rows;
    }
  }
  if (rows > 0) close();
  return scripts;
}

std::string plain_list_html(const std::string& title, const std::vector<LateCard>& late, const std::string& css) {
  const auto rows = static_cast<std::int64_t>(rows_of(late));
  const std::string heading = counted(rows, "more failure", "more failures");
  std::string body;
  for (const LateCard& card : late)
    for (const ReportRow* row : card.rows) body += plain_row(card, *row);
  const std::string nonce = content_id(body);
  return kMark + std::string("<html lang='en'>\n<head>\n<meta charset='utf-8'>\n"
                             "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; style-src 'nonce-") +
         nonce + "'; base-uri 'none'; form-action 'none'\">\n"
         "<meta name='viewport' content='width=device-width, initial-scale=1'>\n"
         "<meta name='color-scheme' content='light dark'>\n<title>" + html_text(heading + " \xE2\x80\x93 " + title) +
         "</title>\n<style nonce='" + nonce + "'>\n" + css + "</style>\n</head>\n<body>\n<main class='page plain'>\n<h1>" +
         html_text(heading) + "</h1>\n<p>Those for which <a href='index.html'>the report</a> has no room.</p>\n"
         "<table>\n<thead><tr><th scope='col'>state</th><th scope='col'>failure</th><th scope='col'>what</th>"
         "<th scope='col'>to see it again</th></tr></thead>\n<tbody>\n" +
         body + "</tbody>\n</table>\n</main>\n</body>\n</html>\n";
}

void remove_old_rest(const std::string& folder, const PageFiles& pages) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto begins_with = [](const fs::path& path, std::string_view text) {
    const Result<std::string> whole = read_file(path.string(), std::size_t{1} << 26);
    return whole && whole->starts_with(text);
  };
  const fs::path list = fs::path(folder) / "more.html";
  if (!pages.contains("more.html") && fs::exists(list, error) && begins_with(list, kMark)) fs::remove(list, error);
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "rows", error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("part-") && name.ends_with(".js") && !pages.contains("rows/" + name)) old.push_back(entry.path());
  }
  for (const fs::path& path : old)
    if (begins_with(path, kCall)) fs::remove(path, error);
}

}  // namespace contort
