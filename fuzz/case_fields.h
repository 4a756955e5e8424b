// Field lists (json_fields.h) of what workers are asked and answer, and of what a run keeps. Included from .cpp files
// only.
#pragma once

#include "corpus/run_fields.h"
#include "fuzz/case_work.h"
#include "fuzz/run_state.h"
#include "model/core/json_fields.h"

namespace contort {

namespace case_rules {
inline const json_fields::Rule kIndices{.low = 0, .high = 0x1p53, .max_count = 1000};
inline const json_fields::Rule kProse{.text = json_fields::Text::prose, .may_be_empty = true};
inline const json_fields::Rule kLabels{.max_count = 100000, .text = json_fields::Text::label};
inline const json_fields::Rule kFolders{.max_count = 100000, .text = json_fields::Text::file};
inline const json_fields::Rule kFamilies{.max_count = 1'000'000, .text = json_fields::Text::prose};
inline const json_fields::Rule kHash{.text = json_fields::Text::hex};
}  // namespace case_rules

template <class V>
void fields(V& v, const CaseTask*) {
  v.field("lineage", &CaseTask::lineage, case_rules::kIndices, "Ancestry of the case, itself last.");
  v.field("family", &CaseTask::family, case_rules::kProse, "The failure to be settled; empty: evaluate.");
  v.field("rank", &CaseTask::rank, {.low = 0, .high = 1'000'000}, "Among the families of the case.");
  v.field("motion_hash", &CaseTask::motion_hash, case_rules::kHash, "Of the first time.");
  v.field("ending", &CaseTask::ending, case_rules::kProse, "How the process ended that ran or shrank it first.");
  v.field("shrinks", &CaseTask::shrinks, {}, "There is time to shrink it.");
  v.field("lead", &CaseTask::lead, case_rules::kProse, "A lead that waits to be shrunk.");
}

template <class V>
void fields(V& v, const NearMiss*) {
  v.field("family", &NearMiss::family, case_rules::kProse, "Subject.");
  v.field("margin", &NearMiss::margin, {.low = 0}, "In the check's scale.");
}

template <class V>
void fields(V& v, const WaiverUse*) {
  v.field("hidden", &WaiverUse::hidden, {.low = 0}, "Findings.");
  v.field("expired", &WaiverUse::expired, {}, "Hides nothing any more.");
}

template <class V>
void fields(V& v, const CaseReport*) {
  v.field("built", &CaseReport::built, {}, "The spec builds.");
  v.field("frames", &CaseReport::frames, {.low = 0}, "Of the motion.");
  v.field("motion_hash", &CaseReport::motion_hash, case_rules::kHash, "Of all frames.");
  v.field("tested", &CaseReport::tested, case_rules::kLabels, "What it was made of.");
  v.field("broken", &CaseReport::broken, case_rules::kFamilies, "Families that failed.");
  v.field("near", &CaseReport::near, {.max_count = 100000}, "Near misses.");
  v.field("waivers", &CaseReport::waivers, {.max_count = 1000}, "Use of each.");
  v.field("confirmed", &CaseReport::confirmed, {}, "Failed twice in the same way.");
  v.field("also", &CaseReport::also, case_rules::kFamilies, "Of the case, and shown by the minimal spec.");
  v.field("met", &CaseReport::met, case_rules::kFamilies, "Leads of other families.");
  v.field("met_once", &CaseReport::met_once, case_rules::kFamilies, "Those that did not happen again.");
  v.field("issue", &CaseReport::issue, case_rules::kProse, "Why the lead could not be written.");
}

template <class V>
void fields(V& v, const PoolEntry*) {
  v.field("margin", &PoolEntry::margin, {.low = 0}, "In the check's scale.");
  v.field("lineage", &PoolEntry::lineage, case_rules::kIndices, "Ancestry of the case.");
}

template <class V>
void fields(V& v, const TargetPool*) {
  v.field("nearest", &TargetPool::nearest, {.max_count = 100}, "Cases that came nearest, in that order.");
  v.field("farthest", &TargetPool::farthest, {.low = 0}, "Greatest margin that was seen.");
}

template <class V>
void fields(V& v, const Island*) {
  v.field("pools", &Island::pools, {.max_count = 100000, .key_text = json_fields::Text::prose}, "By family.");
  v.field("retired", &Island::retired, case_rules::kFamilies, "Families that are broken.");
}

template <class V>
void fields(V& v, const RunState*) {
  v.constant("format", "contort.state/3");
  v.field("plan", &RunState::plan, case_rules::kProse, "What the run was asked for.");
  v.field("next", &RunState::next, run_rules::kTotal, "First case of the next round.");
  v.field("record", &RunState::record, {.required = true}, "What was done so far.");
  v.field("islands", &RunState::islands, {.max_count = kIslands}, "What the search knows.");
  v.field("wanted", &RunState::wanted, {.max_count = 1'000'000}, "Failures that are not settled yet.");
  v.field("new_buckets", &RunState::new_buckets, case_rules::kFolders, "Buckets that this run was the first to fill.");
  v.field("known_buckets", &RunState::known_buckets, case_rules::kFolders, "Buckets that were there before.");
  v.field("unconfirmed", &RunState::unconfirmed, case_rules::kLabels, "Leads whose second run differed.");
  v.field("waivers", &RunState::waivers, {.max_count = 1000}, "Use of each.");
}

}  // namespace contort
