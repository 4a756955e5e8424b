// Field lists (json_fields.h) of the workers' tasks and answers. Included from .cpp files only.
#pragma once

#include "corpus/case_fields.h"
#include "fuzz/messages.h"

namespace contort {

namespace message_rules {
using json_fields::Text;
inline const json_fields::Rule kIndices{.low = 0, .high = 0x1p53, .max_count = 1000};
inline const json_fields::Rule kProse{.text = Text::prose, .may_be_empty = true};
inline const json_fields::Rule kLabels{.max_count = 100'000, .text = Text::label};
inline const json_fields::Rule kFamily{.text = Text::prose};
inline const json_fields::Rule kFamilies{.max_count = 1'000'000, .text = Text::prose};
inline const json_fields::Rule kHash{.text = Text::hex};
inline const json_fields::Rule kLeads{.max_count = 100'000};
}  // namespace message_rules

inline std::string_view type_name(const EvaluateTask*) { return "evaluate"; }
inline std::string_view type_name(const SettleTask*) { return "settle"; }
inline std::string_view type_name(const ShrinkTask*) { return "shrink"; }

template <class V>
void fields(V& v, const EvaluateTask* task) {
  v.constant("type", type_name(task));
  v.field("lineage", &EvaluateTask::lineage, message_rules::kIndices, "Ancestry of the case, itself last.");
  v.field("ends", &EvaluateTask::ends, message_rules::kProse, "How the case ends this build; only the base runs it.");
}

template <class V>
void fields(V& v, const SettleTask* task) {
  v.constant("type", type_name(task));
  v.field("lineage", &SettleTask::lineage, message_rules::kIndices, "Ancestry of the case, itself last.");
  v.field("family", &SettleTask::family, message_rules::kFamily, "The failure to be settled.");
  v.field("rank", &SettleTask::rank, {.low = 0, .high = 1'000'000}, "Among the families of the case.");
  v.field("motion_hash", &SettleTask::motion_hash, message_rules::kHash, "Of the first time.");
  v.field("guarded", &SettleTask::guarded, {}, "Running or shrinking it ended a process before.");
  v.field("shrinks", &SettleTask::shrinks, {}, "There is time to shrink it.");
  v.field("base_hash", &SettleTask::base_hash, message_rules::kProse, "Of the base's motion the first time.");
}

template <class V>
void fields(V& v, const ShrinkTask* task) {
  v.constant("type", type_name(task));
  v.field("lead", &ShrinkTask::lead, message_rules::kProse, "Path of a lead that waits to be shrunk.");
  v.field("guarded", &ShrinkTask::guarded, {}, "Shrinking it ended a process before.");
}

template <class V>
void fields(V& v, const NearMiss*) {
  v.field("family", &NearMiss::family, message_rules::kFamily, "Subject.");
  v.field("margin", &NearMiss::margin, {.low = 0}, "In the check's scale.");
}

template <class V>
void fields(V& v, const WaiverUse*) {
  v.field("hidden", &WaiverUse::hidden, {.low = 0}, "Findings.");
  v.field("expired", &WaiverUse::expired, {}, "Hides nothing any more.");
}

template <class V>
void fields(V& v, const Comparison*) {
  v.field("refusal", &Comparison::refusal, message_rules::kProse, "Why the base has no measurement.");
  v.field("moved", &Comparison::moved, {}, "The motions differ.");
  v.field("first_difference", &Comparison::first_difference, {.low = -1}, "The first frame that does.");
  v.field("base_hash", &Comparison::base_hash, message_rules::kProse, "Of the base's motion.");
  v.field("broke", &Comparison::broke, message_rules::kFamilies, "Failures that the base passes.");
  v.field("worse", &Comparison::worse, message_rules::kFamilies, "Failures that are much deeper.");
  v.field("mended", &Comparison::mended, message_rules::kFamilies, "Failures of the base that are gone.");
}

template <class V>
void fields(V& v, const EvaluateReport*) {
  v.constant("type", "evaluated");
  v.field("built", &EvaluateReport::built, {}, "The spec builds.");
  v.field("frames", &EvaluateReport::frames, {.low = 0}, "Of the motion.");
  v.field("motion_hash", &EvaluateReport::motion_hash, message_rules::kHash, "Of all frames.");
  v.field("tested", &EvaluateReport::tested, message_rules::kLabels, "What it was made of.");
  v.field("unmet", &EvaluateReport::unmet, message_rules::kLabels, "Requests that were not met.");
  v.field("not_judged", &EvaluateReport::not_judged, message_rules::kLabels, "Checks that could not judge.");
  v.field("broken", &EvaluateReport::broken, message_rules::kFamilies, "Families that failed.");
  v.field("near", &EvaluateReport::near, {.max_count = 100'000}, "Near misses.");
  v.field("waivers", &EvaluateReport::waivers, {.max_count = 1000}, "Use of each.");
  v.field("against", &EvaluateReport::against, {}, "Comparison with the base.");
  v.field("refusal", &EvaluateReport::refusal, message_rules::kProse, "Why the spec does not build.");
}

template <class V>
void fields(V& v, const Lead*) {
  v.field("run", &Lead::run, {.required = true}, "Name of the run that found it.");
  v.field("original", &Lead::original, {.required = true}, "As it was drawn.");
  v.field("minimal", &Lead::minimal, {}, "What it was shrunk to.");
  v.field("worst", &Lead::worst, {}, "The deepest that shows the same.");
  v.field("shrunk_from", &Lead::shrunk_from, {}, "The original as a case of the minimal one's family.");
}

template <class V>
void fields(V& v, const SettledLead*) {
  v.field("lead", &SettledLead::lead, {.required = true}, "As it is kept.");
  v.field("confirmed", &SettledLead::confirmed, {}, "Failed twice in the same way.");
  v.field("incidental", &SettledLead::incidental, message_rules::kLeads, "Of other families, met while shrinking.");
  v.field("incidental_unconfirmed", &SettledLead::incidental_unconfirmed, message_rules::kLeads,
          "Those that did not happen again.");
  v.field("incidental_of_base", &SettledLead::incidental_of_base, message_rules::kFamilies,
          "Endings that the base shows as well.");
}

template <class V>
void fields(V& v, const SettleReport*) {
  v.constant("type", "settled");
  v.field("settled", &SettleReport::settled, {.required = true}, "What became of the failure.");
  v.field("issue", &SettleReport::issue, message_rules::kProse, "Why the lead could not be written.");
}

template <class V>
void fields(V& v, const ShrinkReport*) {
  v.constant("type", "shrunk");
  v.field("shrunk", &ShrinkReport::shrunk, {}, "What became of the lead.");
  v.field("issue", &ShrinkReport::issue, message_rules::kProse, "Why the lead could not be written.");
}

}  // namespace contort
