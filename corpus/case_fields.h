// Field lists (json_fields.h) of cases. Included from .cpp files only.
#pragma once

#include "corpus/case.h"
#include "corpus/family_fields.h"
#include "model/spec/spec_fields.h"

namespace contort {

namespace stored_rules {
using json_fields::Rule;
using json_fields::Text;
inline const Rule kText{.text = Text::label, .may_be_empty = true};
inline const Rule kSubject{.text = Text::prose, .required = true};  // four names of up to 64 letters are too long for a
                                                                    // label
inline const Rule kHash{.required = true, .may_be_empty = true};    // parse_case checks when it may be empty
inline const Rule kFrame{.low = 0, .high = 36000};
inline const Rule kNames{.max_count = 64, .text = Text::label};
inline const Rule kWholeNumber{.low = -1, .high = 0x1p53};
}  // namespace stored_rules

template <class V>
void fields(V& v, const Expectation*) {
  v.field("check", &Expectation::check, {.required = true}, "The check that fails.");
  v.field("subject", &Expectation::subject, stored_rules::kSubject,
          "Joint, part or pair of bodies that the check judged.");
  v.field("unit", &Expectation::unit, stored_rules::kText, "Unit of worst_margin.");
  v.field("first_frame", &Expectation::first_frame, stored_rules::kFrame, "First violated frame.");
  v.field("worst_frame", &Expectation::worst_frame, stored_rules::kFrame, "Frame of the worst margin.");
  v.field("last_frame", &Expectation::last_frame, stored_rules::kFrame, "Last violated frame.");
  v.field("worst_margin", &Expectation::worst_margin, {.low = -1e300, .high = 0, .may_be_nan = true},
          "Signed distance to the limit.");
  v.field("depth", &Expectation::depth, {.low = 0, .high = 1e300}, "-worst_margin in the check's scale.");
  v.field("motion_hash", &Expectation::motion_hash, stored_rules::kHash, "Hash of all frames.");
  v.field("character_hash", &Expectation::character_hash, stored_rules::kHash, "Hash of the assembled character.");
  v.field("trace", &Expectation::trace, {.text = json_fields::Text::hex},
          "Hash of the motion up to each frame, four hex digits for each frame.");
  v.field("phase", &Expectation::phase, stored_rules::kText,
          "Circumstances of the worst frame: impact, interrupt, clip_switch, blend, mid_clip or at_rest.");
  v.field("limit_s", &Expectation::limit_s, {.low = 0, .high = 86400},
          "For findings of `timeout`: the time limit that was exceeded.");
  v.field("limit_MB", &Expectation::limit_MB, {.low = 0, .high = 1 << 20},
          "For findings of `memory`: the limit that was exceeded.");
  v.field("printed", &Expectation::printed, {.text = json_fields::Text::prose, .may_be_empty = true},
          "Last output of the generator's program before it ended.");
}

template <class V>
void fields(V& v, const Provenance*) {
  v.field("tool", &Provenance::tool, stored_rules::kText, "Version of Contort that found the failure.");
  v.field("seed", &Provenance::seed, stored_rules::kWholeNumber, "Seed of the run; -1 if a person wrote the spec.");
  v.field("index", &Provenance::index, stored_rules::kWholeNumber, "Index of the case in the run.");
  v.field("shrunk_from", &Provenance::shrunk_from, stored_rules::kText, "Content id of the spec before shrinking.");
  v.field("shrink_evaluations", &Provenance::shrink_evaluations, stored_rules::kFrame,
          "Motions generated while shrinking.");
  v.field("shrink_stopped", &Provenance::shrink_stopped, stored_rules::kText,
          "Reason why shrinking stopped: fixpoint, evaluations, time, flaky or gone.");
  v.field("original_depth", &Provenance::original_depth, {.low = 0, .high = 1e300}, "Depth before any shrinking.");
  v.field("rank", &Provenance::rank, {.low = 0, .high = 1'000'000},
          "Rank among the failures of the drawn case, ordered by first frame; 0 is the earliest.");
  v.field("profile", &Provenance::profile, {.text = json_fields::Text::prose, .may_be_empty = true},
          "Name of the run's profile; empty if the run had none.");
  v.field("met_shrinking", &Provenance::met_shrinking, {.text = json_fields::Text::prose, .may_be_empty = true},
          "Family of the failure during whose shrinking this one appeared; empty if the drawn case showed it.");
  v.field("base", &Provenance::base, stored_rules::kText,
          "Build that served as the base of a comparison, as version and content hash; empty without a comparison.");
  v.field("base_shows", &Provenance::base_shows, stored_rules::kText,
          "Result of the base build: passes_check (no finding of the check), passes (none of the family) or milder.");
  v.field("base_margin", &Provenance::base_margin, {.low = -1e300, .high = 1e300},
          "Margin of the base build for the family, in the check's scale; 0 if the base did not judge the family.");
  v.field("generator", &Provenance::generator, stored_rules::kText,
          "Name of the program that made the motion; empty: the built-in generator.");
  v.field("generator_build", &Provenance::generator_build, stored_rules::kText,
          "Build of the generator, and the hash of its manifest.");
}

template <class V>
void fields(V& v, const Cause*) {
  v.field("scheme", &Cause::scheme, {.low = 0, .high = 1e6},
          "Version of the rules that found the cause; 0: not found yet.");
  v.field("scope", &Cause::scope, {.names = cause_scope_names()},
          "alone: one action fails by itself; company: several fail only together; setting: no action explains it.");
  v.field("names", &Cause::names, stored_rules::kNames, "The culprit, the actions, or the surroundings.");
  v.field("also", &Cause::also, stored_rules::kNames,
          "Other actions that fail by themselves as well; for a setting, the actions of the spec.");
  v.field("simulated", &Cause::is_simulated, {}, "The minimal spec needs dynamics.");
}

template <class V>
void fields(V& v, const Case*) {
  v.constant("format", "contort.case/1");
  v.field("spec", &Case::spec, {.required = true}, "The action specification.");
  v.field("expect", &Case::expect, {.required = true}, "Result of running the spec.");
  v.field("provenance", &Case::provenance, {}, "Origin of the case.");
  v.field("free_fields", &Case::free_fields, {.max_count = 1024, .text = json_fields::Text::label},
          "JSON pointers to fields of the spec that may have any value without changing the failure.");
  v.field("also", &Case::co_failures, {.max_count = 100'000, .text = json_fields::Text::prose},
          "Families of other failures of the original case that this spec shows as well, about as deep; they are "
          "reported together.");
  v.field("cause", &Case::cause, {},
          "For minimal cases: the actions that cause the failure (docs/reference/causes.md).");
}

namespace json_fields {
extern template struct Codec<Case>;  // compiled in case.cpp
}

}  // namespace contort
