#include "fuzz/shrink_state.h"

#include <algorithm>
#include <cmath>

#include "corpus/corpus.h"

namespace contort {

namespace {

double share_of(double depth, double floor) { return std::isinf(depth) ? depth : floor * depth; }

// A fraction of the depth before any shrinking, so that shrinking again does not go from a half to a quarter.
double least_depth_of(const Case& stored, double depth, double floor) {
  const Provenance& from = stored.provenance;
  const double whole = from.shrunk_from.empty() || from.original_depth <= 0.0 ? depth : from.original_depth;
  return std::min(share_of(whole, floor), depth);
}

}  // namespace

ShrinkState::ShrinkState(Trial& trial, const Case& original, Generator& generator, const ShrinkConfig& config)
    : trial_(trial), generator_(generator), config_(config), best_(original) {}

std::vector<SpecField> ShrinkState::spec_fields(const Spec& spec) const {
  return spec_fields_of(spec, generator_, shown_.character.get());
}

bool ShrinkState::spent() {
  if (evaluations_ >= config_.max_evaluations)
    stopped_ = "evaluations";
  else if (config_.out_of_time && config_.out_of_time())
    stopped_ = "time";
  return halted();
}

std::optional<TrialResult> ShrinkState::run(const Spec& candidate) {
  if (spent()) return std::nullopt;
  TrialResult shown = trial_.run(candidate, most_frames_);
  if (shown.built) ++evaluations_;
  if (shown.base > most_) shown.fails = false;
  for (const Case& other : shown.met) meet(other);
  return shown;
}

bool ShrinkState::confirm() {
  const std::optional<TrialResult> first = run(best_.spec);
  const std::optional<TrialResult> second = run(best_.spec);
  if (!first || !second) return false;
  if (first->fails != second->fails || first->expect.motion_hash != second->expect.motion_hash ||
      first->base_hash != second->base_hash)
    stopped_ = "flaky";
  else if (!first->fails)
    stopped_ = "gone";
  if (halted()) return false;
  best_.expect = second->expect;
  best_.free_fields.clear(), best_.co_failures.clear();
  shown_ = *second;
  most_ = shown_.base;
  least_depth_ = least_depth_of(best_, shown_.depth, config_.depth_floor);
  most_frames_ = shown_.most_frames;
  for (const Case& other : trial_.others(best_.spec)) beside_.emplace(family_of(other), other);
  std::erase_if(met_, [&](const auto& met) { return beside_.contains(met.first); });
  return true;
}

bool ShrinkState::accept(Spec candidate) {
  if (halted() || candidate == best_.spec) return false;  // compares before printing, which takes as long as a trial
  const std::string text = print_spec(candidate);
  if (tried_.contains(text) || !allows(candidate)) return false;
  std::optional<TrialResult> shown = run(candidate);
  if (!shown || !shown->built) return false;
  tried_[text] = shown->fails ? shown->depth : -1.0;
  if (!shown->fails || shown->depth < least_depth_) return false;
  if (std::isinf(shown->depth) && !std::isinf(least_depth_)) return false;  // NaN is another fault
  best_.spec = std::move(candidate);
  best_.expect = shown->expect;
  shown_ = std::move(*shown);
  most_ = shown_.base;
  return true;
}

bool ShrinkState::fails(const Spec& candidate) {
  const std::string text = print_spec(candidate);
  if (const auto known = tried_.find(text); known != tried_.end()) return known->second >= 0.0;
  const std::optional<TrialResult> shown = run(candidate);
  if (!shown || !shown->built) return false;
  tried_[text] = shown->fails ? shown->depth : -1.0;
  return shown->fails;
}

std::vector<Case> ShrinkState::others() {
  if (is_abnormal_exit(best_.expect)) return {};  // there is no motion, and a case that hangs would hang again
  trial_.run(best_.spec, most_frames_);
  return trial_.others(best_.spec);
}

Case ShrinkState::before(const Case& other) const {
  const auto in_original = beside_.find(family_of(other));
  Case found = in_original == beside_.end() ? other : in_original->second;
  found.provenance = best_.provenance;
  if (in_original == beside_.end()) found.provenance.met_shrinking = family_of(best_);
  return found;
}

void ShrinkState::meet(const Case& other) {
  const Family family = family_of(other);
  if (beside_.contains(family)) return;
  const auto [known, is_new] = met_.try_emplace(family, other);
  if (!is_new && cheaper(other.spec, known->second.spec)) known->second = other;
}

std::vector<Case> ShrinkState::met() const {
  std::vector<Case> cases;
  for (const auto& [family, other] : met_) cases.push_back(other);
  return cases;
}

std::vector<Family> ShrinkState::still_shown(const std::vector<Case>& others) const {
  std::vector<Family> families;
  for (const Case& other : others) {
    const auto before = beside_.find(family_of(other));
    if (before == beside_.end()) continue;
    const double least = share_of(depth_of(before->second.expect), config_.depth_floor);
    if (depth_of(other.expect) >= least) families.push_back(before->first);
  }
  return families;
}

}  // namespace contort
