// The smallest spec so far and what was tried, for the stages of shrinking.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/shrink.h"

namespace contort {

class ShrinkState {
 public:
  ShrinkState(Trial& trial, const Case& original, const ShrinkConfig& config);

  // Runs the original twice. Only where it fails both times, in the same way, is there something to shrink.
  bool confirm();

  // Makes the candidate the smallest one if it builds, fails in the family, and deeply enough.
  bool accept(Spec candidate);

  bool allows(const Spec& candidate) const { return !config_.allowed || config_.allowed(candidate); }

  // Whether it fails in the family, however deep. False once the budget is spent.
  bool fails(const Spec& candidate);

  // Runs it, known or not; nothing once the budget is spent.
  std::optional<TrialResult> run(const Spec& candidate);

  // Notes what other checks find in the smallest spec. Candidates are judged by the one check alone: by all of them,
  // shrinking takes half as long again.
  void look_around();

  // From here on motions may have this many frames, whatever the original has.
  void allow_frames(int most_frames) { most_frames_ = most_frames; }

  bool halted() const { return stopped_ != "fixpoint"; }
  const Spec& spec() const { return best_.spec; }
  const Case& best() const { return best_; }
  const TrialResult& shown() const { return shown_; }  // of best()
  double depth() const { return shown_.depth; }
  const std::string& stopped() const { return stopped_; }
  int evaluations() const { return evaluations_; }
  std::vector<Case> met() const;

  // The original's other families that the smallest spec shows, as deep as the family itself must stay: by name. One
  // more motion, whatever the budget, unless nothing was shrunk.
  std::vector<std::string> still_shown();

 private:
  bool spent();
  void meet(const Case& other);

  Trial& trial_;
  const ShrinkConfig& config_;
  Case best_;
  TrialResult shown_;
  double least_depth_ = 0.0;
  int most_frames_ = kMaxFrames;         // nothing smaller takes longer than the original
  std::map<std::string, double> tried_;  // depth by the spec's text; -1: does not fail in the family
  std::map<std::string, double> beside_;  // depths of other families in the original
  std::map<std::string, Case> met_;       // by family, none of the original's
  std::string stopped_ = "fixpoint";
  int evaluations_ = 0;
};

}  // namespace contort
