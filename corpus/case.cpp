#include "corpus/case.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "checks/circumstances.h"
#include "model/core/hash.h"
#include "model/spec/spec_fields.h"

namespace contort {

namespace {

using json_fields::Rule;
using json_fields::Text;

const Rule kText{.text = Text::label, .may_be_empty = true};
const Rule kSubject{.text = Text::prose, .required = true};  // four names of up to 64 letters are no label
const Rule kHash{.required = true, .may_be_empty = true};    // parse_case says when
const Rule kFrame{.low = 0, .high = 36000};
const Rule kWholeNumber{.low = -1, .high = 0x1p53};

}  // namespace

template <class V>
void fields(V& v, const Expectation*) {
  v.field("check", &Expectation::check, {.required = true}, "The check that fails.");
  v.field("subject", &Expectation::subject, kSubject, "What it judges.");
  v.field("unit", &Expectation::unit, kText, "Of worst_margin.");
  v.field("first_frame", &Expectation::first_frame, kFrame, "First violated frame.");
  v.field("worst_frame", &Expectation::worst_frame, kFrame, "Frame of the worst margin.");
  v.field("last_frame", &Expectation::last_frame, kFrame, "Last violated frame.");
  v.field("worst_margin", &Expectation::worst_margin, {.low = -1e300, .high = 0, .may_be_nan = true},
          "Signed distance to the limit.");
  v.field("depth", &Expectation::depth, {.low = 0, .high = 1e300}, "-worst_margin in the check's scale.");
  v.field("motion_hash", &Expectation::motion_hash, kHash, "Hash of all frames.");
  v.field("character_hash", &Expectation::character_hash, kHash, "Hash of the assembled character.");
  v.field("trace", &Expectation::trace, {.text = Text::hex}, "Running hash, four hex digits a frame.");
  v.field("phase", &Expectation::phase, kText,
          "What was going on in the worst frame: impact, interrupt, clip_switch, blend, mid_clip or at_rest.");
  v.field("limit_s", &Expectation::limit_s, {.low = 0, .high = 86400},
          "Of a timeout: it did not end in so many seconds.");
  v.field("limit_MB", &Expectation::limit_MB, {.low = 0, .high = 1 << 20}, "Of memory: it took more than this.");
}

template <class V>
void fields(V& v, const Provenance*) {
  v.field("tool", &Provenance::tool, kText, "Version that found it.");
  v.field("seed", &Provenance::seed, kWholeNumber, "Of the run; -1: written by a person.");
  v.field("index", &Provenance::index, kWholeNumber, "Of the case in the run.");
  v.field("shrunk_from", &Provenance::shrunk_from, kText, "Content id of the spec before shrinking.");
  v.field("shrink_evaluations", &Provenance::shrink_evaluations, kFrame, "Motions generated while shrinking.");
  v.field("shrink_stopped", &Provenance::shrink_stopped, kText, "fixpoint, evaluations, time, flaky or gone.");
  v.field("original_depth", &Provenance::original_depth, {.low = 0, .high = 1e300}, "Depth before any shrinking.");
  v.field("rank", &Provenance::rank, {.low = 0, .high = 1'000'000},
          "Among the failures of its case by first frame; 0: the earliest.");
  v.field("profile", &Provenance::profile, {.text = Text::prose, .may_be_empty = true},
          "Profile of the run, by name; empty: it draws everything.");
  v.field("met_shrinking", &Provenance::met_shrinking, {.text = Text::prose, .may_be_empty = true},
          "Family of the failure whose shrinking met this one; empty: the case itself showed it.");
}

template <class V>
void fields(V& v, const Case*) {
  v.constant("format", "contort.case/1");
  v.field("spec", &Case::spec, {.required = true}, "The action specification.");
  v.field("expect", &Case::expect, {.required = true}, "What running it shows.");
  v.field("provenance", &Case::provenance, {}, "Where it came from.");
  v.field("free_fields", &Case::free_fields, {.max_count = 1024, .text = Text::label},
          "Pointers into the spec: fields that could as well have other values.");
  v.field("also", &Case::also, {.max_count = 100'000, .text = Text::prose},
          "Families of the original's other failures that this spec shows too, about as deep: told with this one.");
}

std::string family_of(const Case& stored) {
  return stored.expect.check + "|" + stored.spec.character.name + "|" + stored.expect.subject;
}

FamilyParts family_parts(const std::string& family) {
  const std::size_t first = std::min(family.find('|'), family.size());
  const std::size_t second = std::min(family.find('|', first + 1), family.size());
  const auto after = [&](std::size_t bar) { return std::min(bar + 1, family.size()); };
  return {family.substr(0, first), family.substr(after(first), second - after(first)), family.substr(after(second))};
}

double depth_of(const Expectation& expect) {
  return std::isnan(expect.worst_margin) ? std::numeric_limits<double>::infinity() : expect.depth;
}

bool is_ending(const Expectation& expect) {
  return expect.check == "crash" || expect.check == "timeout" || expect.check == "memory";
}

Result<Case> parse_case(std::string_view json) {
  Result<Case> read = json_fields::read_document<Case>(json, "case");
  if (!read || is_ending(read->expect)) return read;
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
  // JSON has neither infinity nor NaN; the one is stored as the other, which has its own spelling.
  if (std::isinf(finding.worst_margin)) expect.worst_margin = std::numeric_limits<double>::quiet_NaN();
  if (std::isfinite(finding.depth)) expect.depth = finding.depth;
  expect.motion_hash = to_hex(evaluation.motion_hash);
  expect.character_hash = to_hex(execution.character->hash());
  if (!finding.check.empty() && execution.intent)
    expect.phase = phase_name(phase_of(*execution.intent, motion, finding.worst_frame));
  for (const std::uint16_t step : motion_trace(motion)) expect.trace += to_hex(step).substr(12);
  return expect;
}

}  // namespace contort
