// Field lists (json_fields.h) of the state that a run keeps. Included from .cpp files only.
#pragma once

#include "corpus/run_fields.h"
#include "fuzz/message_fields.h"
#include "fuzz/run_state.h"

namespace contort {

template <class V>
void fields(V& v, const PoolEntry*) {
  v.field("margin", &PoolEntry::margin, {.low = 0}, "In the check's scale.");
  v.field("lineage", &PoolEntry::lineage, message_rules::kIndices, "Ancestry of the case.");
}

template <class V>
void fields(V& v, const TargetPool*) {
  v.field("nearest", &TargetPool::nearest, {.max_count = 100}, "Cases that came nearest, in that order.");
  v.field("farthest", &TargetPool::farthest, {.low = 0}, "Greatest margin that was seen.");
}

template <class V>
void fields(V& v, const Island*) {
  v.field("pools", &Island::pools, {.max_count = 100000, .key_text = json_fields::Text::prose}, "By family.");
  v.field("retired", &Island::retired, message_rules::kFamilies, "Families that are broken.");
}

template <class V>
void fields(V& v, const Ingredients*) {
  v.field("setting", &Ingredients::setting, {.low = -1, .high = 0x1p53}, "Index that draws the setting of its epoch.");
  v.field("clean", &Ingredients::clean, message_rules::kIndices, "Singles without a finding.");
  v.field("failing", &Ingredients::failing, {.max_count = 1000}, "Pairs with a finding.");
}

template <class V>
void fields(V& v, const CaseGroup*) {
  v.field("shown", &CaseGroup::shown, message_rules::kFamilies, "Families that they showed.");
}

inline const json_fields::Rule kStateFolders{.max_count = 100'000, .text = json_fields::Text::file};

template <class V>
void fields(V& v, const RunState*) {
  v.constant("format", "contort.state/5");
  v.field("plan", &RunState::plan, message_rules::kProse, "What the run was asked for.");
  v.field("next", &RunState::next, run_rules::kTotal, "First case of the next round.");
  v.field("record", &RunState::record, {.required = true}, "What was done so far.");
  v.field("islands", &RunState::islands, {.max_count = kIslands}, "What the search knows.");
  v.field("ingredients", &RunState::ingredients, {.max_count = kIslands}, "What the stages know, by island.");
  v.field("groups", &RunState::groups, {.max_count = kIslands}, "The cases of the present epoch, by island.");
  v.field("wanted", &RunState::wanted, {.max_count = 1'000'000}, "Failures that are not settled yet.");
  v.field("new_buckets", &RunState::new_buckets, kStateFolders, "Buckets that this run was the first to fill.");
  v.field("known_buckets", &RunState::known_buckets, kStateFolders, "Buckets that were there before.");
  v.field("unconfirmed", &RunState::unconfirmed, message_rules::kLabels, "Leads whose second run differed.");
  v.field("waivers", &RunState::waivers, {.max_count = 1000}, "Use of each.");
}

}  // namespace contort
