#include "renders/report.h"

#include <algorithm>
#include <cmath>

#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"
#include "renders/report_rest.h"
#include "renders/tested_html.h"
#include "renders/wording.h"

namespace contort {
namespace {

using json_fields::Json;

Json spec_of(const std::string& text) {
  const Result<Json> spec = json_fields::parse_document(text);
  return spec ? *spec : Json(text);  // A spec that cannot be parsed is still shown.
}

Json texts_of(const std::vector<Family>& families) {
  Json texts = Json::array();
  for (const Family& family : families) texts.push_back(print_family(family));
  return texts;
}

Json row_json(const ReportRow& row) {
  return {{"family", row.family},
          {"check", row.check},
          {"subject", row.subject},
          {"unit", row.unit},
          {"worst_margin", std::isfinite(row.worst_margin) ? Json(row.worst_margin) : Json()},  // null for NaN
          {"measured", row.measured},
          {"cases_seen", row.cases_seen},
          {"bucket", row.bucket},
          {"state", row.state},
          {"gating", row.gating},
          {"spec", spec_of(row.spec_json)},
          {"replay_command", row.replay_command},
          {"strip", row.strip},
          {"clip", row.clip},
          {"first_frame", row.first_frame},
          {"worst_frame", row.worst_frame},
          {"last_frame", row.last_frame},
          {"rate_hz", std::isfinite(row.rate_hz) ? Json(row.rate_hz) : Json()},
          {"features", row.features},
          {"needs", row.needs},
          {"also", texts_of(row.co_failures)},
          {"phase", row.phase},
          {"since_base", row.since_base},
          {"note", row.note}};
}

Json cause_json(const ReportCause& cause) {
  return {{"id", cause.id},       {"headline", cause.headline},     {"severity", cause.severity},
          {"cases", cause.cases}, {"characters", cause.characters}, {"buckets", cause.buckets},
          {"conditions", cause.conditions}, {"news", cause_news_names()[static_cast<std::size_t>(cause.news)]}};
}

Json search_json(const SearchProgress& search) {
  Json arms = Json::array();
  for (const ArmProgress& arm : search.arms)
    arms.push_back({{"name", arm.name}, {"cases", arm.cases}, {"failing", arm.failing}, {"families", arm.families}});
  return {{"discovered", search.discovered},
          {"met_once", search.met_once},
          {"lone_cases", search.lone_cases},
          {"unseen_share", unseen_share(search)},
          {"arms", arms}};
}

}  // namespace

RowCounts row_counts(const ReportModel& model) {
  RowCounts counts;
  for (const ReportRow& row : model.rows)
    ++(row.state == "fixed"         ? counts.fixed
       : row.state == "waiting"     ? counts.waiting
       : row.state == "unconfirmed" ? counts.unconfirmed
                                    : counts.failures);
  return counts;
}

std::string failures_text(const ReportModel& model) {
  const RowCounts counts = row_counts(model);
  std::string text = counted(counts.failures, "failure", "failures") + " of " +
                     counted(std::ssize(model.causes), "cause", "causes");
  if (counts.fixed > 0) text += "; " + count_text(counts.fixed) + " fixed";
  if (counts.waiting > 0) text += "; " + counted(counts.waiting, "waits", "wait") + " to be shrunk";
  if (counts.unconfirmed > 0) text += "; " + count_text(counts.unconfirmed) + " seen only once";
  return text;
}

std::string gate_text(const ReportModel& model) {
  const auto count = [&](auto&& is_wanted) {
    return std::ranges::count_if(model.rows, [&](const ReportRow& row) { return row.gating && is_wanted(row); });
  };
  const std::int64_t failures = count(is_shrunk);
  const std::int64_t waiting = count([](const ReportRow& row) { return row.state == "waiting"; });
  if (failures == 0 && waiting == 0) return "nothing fails the build";
  if (failures == 0)
    return counted(waiting, "failure that waits to be shrunk fails", "failures that wait to be shrunk fail") +
           " the build";
  const std::string text = counted(failures, "failure fails", "failures fail") + " the build";
  return waiting == 0 ? text : text + ", " + counted(waiting, "more waits", "more wait") + " to be shrunk";
}

std::string unsettled_text(std::int64_t unsettled) {
  if (unsettled == 0) return "";
  return counted(unsettled, "more failure of a stopped run is", "more failures of a stopped run are") +
         " not shown: repeat its contort fuzz with --resume.";
}

std::string value_text(const ReportRow& row) {
  if (!row.sentence.empty() || !row.has_motion) return row.sentence;
  return "worst " + margin_text(row.worst_margin, row.unit);
}

bool is_shrunk(const ReportRow& row) { return row.state != "waiting" && row.state != "unconfirmed"; }

namespace {

Json counts_json(const std::map<std::string, std::int64_t>& counts) {
  Json list = Json::array();
  for (const auto& [name, cases] : counts) list.push_back({{"name", name}, {"cases", cases}});
  return list;
}

}  // namespace

std::string report_json(const ReportModel& model) {
  Json json = {{"format", "contort.report/1"}, {"title", model.title},       {"cases", model.cases},
               {"frames", model.frames},       {"findings", model.findings}, {"families", model.families},
               {"buckets", model.buckets},     {"elapsed", model.elapsed},   {"rows", Json::array()},
               {"search", search_json(model.search)},
               {"pairs_possible", pair_counts(model).possible},
               {"causes", Json::array()},
               {"tested", Json::array()}};
  for (const ReportRow& row : model.rows) json["rows"].push_back(row_json(row));
  for (const ReportCause& cause : model.causes) json["causes"].push_back(cause_json(cause));
  for (const auto& [name, count] : model.tested) json["tested"].push_back({{"name", name}, {"count", count}});
  json["unmet"] = counts_json(model.unmet), json["not_judged"] = counts_json(model.not_judged);
  if (model.unsettled > 0) json["unsettled"] = model.unsettled;
  if (model.refused > 0) json["refused"] = model.refused, json["refusals"] = Json::array();
  for (const RefusalCount& count : by_frequency(model.refusals))
    json["refusals"].push_back({{"reason", count.text}, {"cases", count.cases}});
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Done> write_report(const ReportModel& model, const std::string& folder) {
  for (const char* own : {"/strips", "/cases", "/rows", "/viewer"})  // old files in these folders are removed
    if (Result<Done> inside = check_inside(folder, folder + own); !inside) return inside;
  if (Result<Done> made = make_folder(folder); !made) return made;
  if (Result<Done> written = write_file(folder + "/report.json", report_json(model)); !written) return written;
  const PageFiles pages = report_pages(model);
  if (pages.size() > 1)
    if (Result<Done> made = make_folder(folder + "/rows"); !made) return made;
  for (const auto& [path, text] : pages)
    if (Result<Done> written = write_file(folder + "/" + path, text); !written) return written;
  remove_old_rest(folder, pages);
  return Done{};
}

}  // namespace contort
