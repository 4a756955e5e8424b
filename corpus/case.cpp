#include "corpus/case.h"

#include <cmath>
#include <limits>
#include <utility>

#include "checks/circumstances.h"
#include "corpus/case_fields.h"
#include "model/core/hash.h"

namespace contort {

template struct json_fields::Codec<Case>;

Family family_of(const Case& stored) {
  return {stored.expect.check, stored.spec.character.name, stored.expect.subject};
}

Cause cause_of(const Case& minimal) {
  return minimal.cause.scheme > 0 ? minimal.cause : cause_without_experiments(minimal.spec);
}

std::string cause_id_of(const Case& minimal) { return cause_id(cause_of(minimal), kind_of_check(minimal.expect.check)); }

double depth_of(const Expectation& expect) {
  return std::isnan(expect.worst_margin) ? std::numeric_limits<double>::infinity() : expect.depth;
}

bool is_abnormal_exit(const Expectation& expect) {
  return expect.check == "crash" || expect.check == "timeout" || expect.check == "memory";
}

Result<Case> parse_case(std::string_view json) {
  Result<Case> read = json_fields::read_document<Case>(json, "case");
  if (!read || is_abnormal_exit(read->expect)) return read;
  for (const auto& [hash, name] :
       {std::pair(&read->expect.motion_hash, "motion_hash"), std::pair(&read->expect.character_hash, "character_hash")})
    if (hash->empty())
      return Issue{"case.bad_text", std::string("/expect/") + name,
                   "found nothing; only a crash, a timeout or memory has no hash"};
  return read;
}
std::string print_case(const Case& stored) { return json_fields::write_pretty(stored); }
std::string case_schema() { return json_fields::write_schema<Case>("Contort case"); }

Expectation expectation_of(const Execution& execution, const Evaluation& evaluation, const Finding& finding) {
  const Motion& motion = execution.motion;
  Expectation expect{finding.check,
                     finding.subject,
                     finding.unit,
                     finding.first_frame,
                     finding.worst_frame,
                     finding.last_frame,
                     finding.worst_margin,
                     0.0,
                     {},
                     {},
                     {},
                     {}};
  // JSON has neither infinity nor NaN. Infinity is stored as NaN, for which the format has a word.
  if (std::isinf(finding.worst_margin)) expect.worst_margin = std::numeric_limits<double>::quiet_NaN();
  if (std::isfinite(finding.depth)) expect.depth = finding.depth;
  expect.motion_hash = to_hex(evaluation.motion_hash);
  expect.character_hash = to_hex(execution.character->hash());
  if (!finding.check.empty() && execution.intent)
    expect.phase = phase_name(phase_of(*execution.intent, motion, finding.worst_frame));
  for (const std::uint16_t step : motion_trace(motion)) expect.trace += to_hex(step).substr(12);
  return expect;
}

std::string cause_headline(const Case& minimal) {
  const Expectation& expect = minimal.expect;
  return cause_headline(cause_of(minimal), expect.check, std::span(&expect.subject, 1), &minimal.spec.environment);
}

}  // namespace contort
