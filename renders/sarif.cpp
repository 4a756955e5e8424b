#include <cmath>
#include <map>

#include "checks/check.h"
#include "model/core/json_fields.h"
#include "renders/ci_outputs.h"
#include "renders/html.h"
#include "renders/wording.h"

namespace contort {

namespace {

using json_fields::Json;

Json text_json(const std::string& text) { return {{"text", one_line(text)}}; }

std::string help_of(const std::string& check) {
  for (const CheckDef& def : all_checks())
    if (def.name == check) return std::string(def.help);
  return check;
}

// Hidden failures stay in the log, marked as hidden.
Json suppressions_json(const ReportRow& row) {
  return Json::array({{{"kind", "external"}, {"status", "accepted"}, {"justification", one_line(row.note)}}});
}

Json location_json(const ReportRow& row) {
  return {
      {"physicalLocation", {{"artifactLocation", {{"uri", html_url(row.case_file)}}}, {"region", {{"startLine", 1}}}}}};
}

std::string since_text(const ReportRow& row) { return row.since_base.empty() ? "" : ", " + row.since_base; }

Json result_json(const ReportRow& row, int rule) {
  Json result = {{"ruleId", one_line(row.check)},
                 {"ruleIndex", rule},
                 {"level", row.gating ? "error" : "note"},
                 {"message", text_json(row.state + ": " + row.family + ", " + value_text(row) +
                                       " at frame " + std::to_string(row.worst_frame) + since_text(row) + ". " +
                                       row.replay_command)},
                 {"locations", Json::array({location_json(row)})},
                 // GitHub recognises an alert by primaryLocationLineHash only. Without it, it would hash the file's
                 // text, which changes with each smaller case.
                 {"partialFingerprints",
                  {{"contort/v1", one_line(row.bucket)}, {"primaryLocationLineHash", one_line(row.bucket) + ":1"}}},
                 {"properties", {{"state", one_line(row.state)}, {"family", one_line(row.family)}}}};
  if (row.state == "quarantined" && !row.gating) result["suppressions"] = suppressions_json(row);
  return result;
}

Json rule_json(const std::string& check) {
  return {{"id", one_line(check)},
          {"shortDescription", text_json(check)},
          {"fullDescription", text_json(help_of(check))},
          {"help", text_json(help_of(check))},
          {"defaultConfiguration", {{"level", "error"}}}};
}

Json invocation_json(std::size_t left_out) {
  Json invocation = {{"executionSuccessful", true}};
  if (left_out > 0)
    invocation["toolExecutionNotifications"] = Json::array(
        {{{"level", "note"}, {"message", text_json(std::to_string(left_out) + " more results are left out")}}});
  return invocation;
}

}  // namespace

std::string sarif_json(const ReportModel& model) {
  std::map<std::string, int> rule_of;
  Json rules = Json::array(), results = Json::array();
  std::size_t left_out = 0;
  for (const ReportRow* row : gating_first(model)) {
    if (row->state == "fixed") continue;
    if (results.size() == kMostSarifResults) {
      ++left_out;
      continue;
    }
    const auto [rule, is_new] = rule_of.try_emplace(row->check, static_cast<int>(rules.size()));
    if (is_new) rules.push_back(rule_json(row->check));
    results.push_back(result_json(*row, rule->second));
  }
  const Json driver = {{"name", "Contort"}, {"version", one_line(model.tool)}, {"rules", rules}};
  const Json run = {
      {"tool", {{"driver", driver}}}, {"invocations", Json::array({invocation_json(left_out)})}, {"results", results}};
  const Json log = {
      {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"}, {"version", "2.1.0"}, {"runs", Json::array({run})}};
  return log.dump(1) + "\n";
}

}  // namespace contort
