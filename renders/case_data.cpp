#include "renders/case_data.h"

#include <algorithm>

#include "corpus/evaluator.h"
#include "formats/gltf/write.h"
#include "model/core/base64.h"
#include "renders/check_words.h"
#include "renders/gzip.h"
#include "renders/highlight.h"
#include "renders/measured_text.h"
#include "renders/needs.h"
#include "renders/page_call.h"
#include "renders/scene_fields.h"
#include "renders/wording.h"

namespace contort {

namespace {

using json_fields::Json;
using namespace scene;

// Returns "" for motions that a .glb cannot hold, such as those that are not finite. Their margins are shown
// nevertheless.
std::string glb_text(const Character& character, const Motion& motion) {
  const Result<std::vector<std::byte>> glb = write_glb(character, motion, {});
  return glb ? to_base64(gzipped(*glb)) : "";
}

// The target motion of dynamics; without frames if there is none.
Motion target_of(const Motion& motion) {
  Motion target;
  if (motion.response.target_root.empty()) return target;
  target.rate_hz = motion.rate_hz, target.frame_count = motion.frame_count, target.coord_count = motion.coord_count;
  target.coords = motion.response.target_coords, target.root = motion.response.target_root;
  return target;
}

Json unmet_requests_json(const Execution& execution) {
  Json list = Json::array();
  if (!execution.intent) return list;
  for (const UnmetRequest& unmet : execution.intent->unmet)
    list.push_back({{"action", unmet.action},
                    {"slot", execution.character->parts()[static_cast<std::size_t>(unmet.part)].slot},
                    {"first_frame", unmet.first_frame},
                    {"last_frame", unmet.last_frame},
                    {"why", shortfall_text(unmet.why)}});
  return list;
}

Json unjudged_checks_json(const std::vector<NotJudged>& checks) {
  Json list = Json::array();
  for (const NotJudged& one : checks)
    list.push_back({{"check", one.check}, {"title", check_title(one.check)}, {"reason", one.reason}});
  return list;
}

// The value and the limit of a finding in words; "" if there is none.
std::string measured_in(const Character& character, const CheckSettings& settings, const Finding& about,
                        bool is_of_program) {
  if (about.first_frame < 0) return "";
  const bool has_own_limit = is_of_program && about.check == "reach_error";
  return failed_text({about.check, about.subject, about.unit, about.worst_margin, has_own_limit}, &character, settings);
}

Result<Json> motion_json(const ShownCase& shown, Generator& generator, const CheckSettings& settings) {
  Evaluator evaluator(generator, settings);
  const Result<Evaluation> evaluation = evaluator.run(shown.stored.spec);
  if (!evaluation) return evaluation.issue();
  const Execution& execution = evaluator.execution();
  const Character& character = *execution.character;
  const Motion& motion = execution.motion;
  Finding about;
  about.check = shown.stored.expect.check, about.subject = shown.stored.expect.subject;
  about.first_frame = about.worst_frame = about.last_frame = -1;
  if (const Finding* found = deepest(evaluation->findings, about.check, about.subject)) about = *found;
  const Motion target = target_of(motion);
  return Json{{"role", shown.role},
              {"rate_hz", motion.rate_hz},
              {"frame_count", motion.frame_count},
              {"first_frame", about.first_frame},
              {"worst_frame", about.worst_frame},
              {"last_frame", about.last_frame},
              {"spec", *json_fields::parse_document(print_spec(shown.stored.spec))},
              {"free_fields", shown.stored.free_fields},
              {"glb", glb_text(character, motion)},
              {"ghost_glb", target.frame_count > 0 ? glb_text(character, target) : ""},
              {"colliders", colliders_json(character)},
              {"highlight", highlight_json(character, highlighted(character, about))},
              {"ground", ground_json(execution.environment, motion.root)},
              {"obstacles", obstacles_json(execution.environment)},
              {"spans", spans_json(execution)},
              {"marks", marks_json(execution)},
              {"balance", balance_json(motion)},
              {"measured", measured_in(character, settings, about, !shown.stored.provenance.generator.empty())},
              {"unmet", unmet_requests_json(execution)},
              {"not_judged", unjudged_checks_json(evaluation->not_judged)},
              {"curves", curves_json(evaluator.curves(about, kMostCurves))}};
}

}  // namespace

Result<std::string> case_data(const std::string& key, std::span<const ShownCase> shown, Generator& generator,
                              const CheckSettings& settings, const std::string& strip) {
  const Expectation& expect = shown.front().stored.expect;
  const auto check = std::ranges::find(all_checks(), expect.check, &CheckDef::name);
  Json json = {{"format", "contort.report_case/1"},
               {"key", key},
               {"check", expect.check},
               {"title", check_title(expect.check)},
               {"character", shown.front().stored.spec.character.name},
               {"subject", expect.subject},
               {"unit", expect.unit},
               {"needs", needs_of(shown.front().stored.spec)},
               {"meaning", check == all_checks().end() ? "" : check->help},
               {"worst_margin", number(expect.worst_margin)},
               {"first_frame", expect.first_frame},
               {"worst_frame", expect.worst_frame},
               {"last_frame", expect.last_frame},
               {"motions", Json::array()}};
  if (!strip.empty()) json["strip"] = strip;
  if (!expect.phase.empty()) json["phase"] = phase_text(expect.phase);
  for (const ShownCase& one : shown) {
    Result<Json> motion = motion_json(one, generator, settings);
    if (motion)
      json["motions"].push_back(std::move(motion).value());
    else if (&one == &shown.front())
      return motion.issue();
  }
  return without_markup(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string case_problem(const std::string& key, const std::string& why) {
  const Json json = {{"format", "contort.report_case/1"}, {"key", key}, {"problem", why}};
  return without_markup(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string case_script(const std::string& key, const std::string& data, const std::string& stamp) {
  return page_call("contortCase", key, data, stamp);
}

std::string data_of_script(const std::string& key, const std::string& script) {
  return data_of_page_call("contortCase", key, script);
}

}  // namespace contort
