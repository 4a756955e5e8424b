// Field lists (json_fields.h) of run records. Included from .cpp files only.
#pragma once

#include "corpus/family_fields.h"
#include "corpus/runs.h"
#include "model/core/json_fields.h"

namespace contort {

namespace run_rules {
inline const json_fields::Rule kTotal{.low = 0, .high = 0x1p53};
inline const json_fields::Rule kLabel{.text = json_fields::Text::label, .may_be_empty = true};
inline constexpr std::size_t kMostEntries = 100'000;  // the most entries of a list, as of an object (json_fields.cpp)
inline constexpr int kMostShrinks = 1000;  // the most shrinks of one family
}  // namespace run_rules

template <class V>
void fields(V& v, const FamilyCount*) {
  v.field("cases", &FamilyCount::cases, run_rules::kTotal, "Cases that showed it.");
  v.field("groups", &FamilyCount::groups, run_rules::kTotal, "Groups of cases with at least one of them.");
  v.field("first_index", &FamilyCount::first_index, run_rules::kTotal, "The first of them.");
  v.field("first_indices", &FamilyCount::first_indices,
          {.low = 0, .high = 0x1p53, .max_count = run_rules::kMostShrinks},
          "The first of those in which it was one of the earliest failures: they go into buckets.");
  v.field("first_arm", &FamilyCount::first_arm, {.may_be_empty = true}, "How the first one was drawn.");
}

template <class V>
void fields(V& v, const StrategyCount*) {
  v.field("cases", &StrategyCount::cases, run_rules::kTotal, "Cases that were drawn in this way.");
  v.field("failing", &StrategyCount::failing, run_rules::kTotal, "Of these with at least one finding.");
}

template <class V>
void fields(V& v, const RefusalCount*) {
  v.field("cases", &RefusalCount::cases, run_rules::kTotal, "Cases that were refused for this reason.");
  v.field("first_index", &RefusalCount::first_index, run_rules::kTotal, "The first of them.");
  v.field("text", &RefusalCount::text, {.text = json_fields::Text::prose, .may_be_empty = true}, "Its reason.");
}

template <class V>
void fields(V& v, const AgainstCounts*) {
  const json_fields::Rule index{.low = -1, .high = 0x1p53};
  const json_fields::Rule prose{.text = json_fields::Text::prose, .may_be_empty = true};
  v.field("base", &AgainstCounts::base, {.text = json_fields::Text::label, .required = true}, "The other build.");
  v.field("build", &AgainstCounts::build, run_rules::kLabel, "This build.");
  v.field("same", &AgainstCounts::same, run_rules::kTotal, "Cases without any difference.");
  v.field("moved", &AgainstCounts::moved, run_rules::kTotal, "Cases that only move differently.");
  v.field("broke", &AgainstCounts::broke, run_rules::kTotal, "Cases with a failure that the base passes.");
  v.field("worse", &AgainstCounts::worse, run_rules::kTotal, "Cases with a failure that is much deeper.");
  v.field("mended", &AgainstCounts::mended, run_rules::kTotal, "Cases with a failure of the base that is gone.");
  v.field("refused", &AgainstCounts::refused, run_rules::kTotal, "Cases for which the base has no answer.");
  v.field("first_moved", &AgainstCounts::first_moved, index, "Index of the first that moved.");
  v.field("first_moved_frame", &AgainstCounts::first_moved_frame, {.low = -1}, "First frame that differs there.");
  v.field("first_refused", &AgainstCounts::first_refused, index, "Index of the first that was refused.");
  v.field("first_refusal", &AgainstCounts::first_refusal, prose, "Its reason.");
}

template <class V>
void fields(V& v, const RunRecord*) {
  v.constant("format", "contort.run/4");
  v.field("name", &RunRecord::name, {.required = true}, "Name of the run.");
  v.field("tool", &RunRecord::tool, run_rules::kLabel, "Version.");
  v.field("shard", &RunRecord::shard, {.low = 0, .high = 63}, "Which share of the run, from 0.");
  v.field("shards", &RunRecord::shards, {.low = 1, .high = 64}, "Of how many.");
  v.field("shrinks_per_family", &RunRecord::shrinks_per_family, {.low = 1, .high = run_rules::kMostShrinks},
          "Failures of a family that go into buckets.");
  v.field("cases", &RunRecord::cases, run_rules::kTotal, "Cases that ran.");
  v.field("frames", &RunRecord::frames, run_rules::kTotal, "Frames that they had.");
  v.field("failing", &RunRecord::failing, run_rules::kTotal, "Cases with at least one finding.");
  v.field("groups", &RunRecord::groups, run_rules::kTotal, "Groups of cases that share a setting; 0: not counted.");
  v.field("discarded", &RunRecord::discarded, run_rules::kTotal, "Drawn specs that were refused.");
  using json_fields::Text;
  const json_fields::Rule counts{.low = 0, .high = 0x1p53, .max_count = run_rules::kMostEntries, .key_text = Text::label};
  v.field("tested", &RunRecord::tested, counts, "What the cases were made of.");
  v.field("unmet", &RunRecord::unmet, counts, "Cases with a request that the generator could not meet.");
  v.field("not_judged", &RunRecord::not_judged, counts, "Cases that a check could not judge, with the reason.");
  v.field("families", &RunRecord::families, {.max_count = run_rules::kMostEntries, .key_text = Text::prose},
          "Failures, by family.");
  v.field("arms", &RunRecord::arms, {.max_count = 100}, "Ways of drawing.");
  v.field("against", &RunRecord::against, {}, "Comparison with another build.");
  v.field("refusals", &RunRecord::refusals, {.max_count = run_rules::kMostEntries, .key_text = Text::prose},
          "Refused specs, by reason without its numbers.");
}

}  // namespace contort
