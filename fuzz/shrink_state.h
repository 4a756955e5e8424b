// The smallest spec so far and the candidates that were tried, for the stages of shrinking.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/spec_field.h"
#include "fuzz/shrink.h"

namespace contort {

class ShrinkState {
 public:
  ShrinkState(Trial& trial, const Case& original, Generator& generator, const ShrinkConfig& config);

  // Runs the original twice. It can be shrunk only if it fails both times in the same way.
  bool confirm();

  // Makes the candidate the smallest one if it builds, fails in the family, and deeply enough.
  bool accept(Spec candidate);

  bool allows(const Spec& candidate) const { return !config_.allowed || config_.allowed(candidate); }

  // Returns true if the spec fails in the family, at any depth; false once the budget is spent.
  bool fails(const Spec& candidate);

  // Runs the spec even if its result is known; no result once the budget is spent.
  std::optional<TrialResult> run(const Spec& candidate);

  // The other families that the smallest spec shows, from one more motion regardless of the budget; none for a failure
  // that ends its process. Candidates are judged by one check only, because judging them by all checks takes half as
  // long again.
  std::vector<Case> others();

  // Adds a case of a family that the original does not show.
  void meet(const Case& other);

  // Allows motions of this many frames from now on, even if the original has fewer.
  void allow_frames(int most_frames) { most_frames_ = most_frames; }

  // The fields of a spec that has the character of best().
  std::vector<SpecField> spec_fields(const Spec& spec) const;

  const Library& library() const { return *generator_.manifest().library; }

  bool halted() const { return stopped_ != "fixpoint"; }
  const Spec& spec() const { return best_.spec; }
  const Case& best() const { return best_; }
  const TrialResult& shown() const { return shown_; }  // the result of best()
  double depth() const { return shown_.depth; }
  const std::string& stopped() const { return stopped_; }
  int evaluations() const { return evaluations_; }
  std::vector<Case> met() const;

  // Other families that both the original and the smallest spec show, at least as deep as the family itself must stay.
  std::vector<Family> still_shown(const std::vector<Case>& others) const;

  // Returns such a family as a case of the original, or else of the smallest spec.
  Case before(const Case& other) const;

 private:
  bool spent();

  Trial& trial_;
  Generator& generator_;
  const ShrinkConfig& config_;
  Case best_;
  TrialResult shown_;
  double least_depth_ = 0.0;
  BaseShows most_ = BaseShows::milder;   // a candidate must be at least as clear a regression as the smallest spec
  int most_frames_ = kMaxFrames;         // a smaller spec must not take longer than the original
  std::map<std::string, double> tried_;  // depth by the spec's text; -1: does not fail in the family
  std::map<Family, Case> beside_;        // the original's other families
  std::map<Family, Case> met_;           // families that the original does not show
  std::string stopped_ = "fixpoint";
  int evaluations_ = 0;
};

}  // namespace contort
