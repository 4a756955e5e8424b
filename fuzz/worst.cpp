#include "fuzz/worst.h"

#include <cmath>
#include <set>

#include "fuzz/spec_field.h"
#include "fuzz/shrink_state.h"
#include "model/core/math.h"

namespace contort {

namespace {

constexpr int kMostEvaluations = 100;

class Climb {
 public:
  explicit Climb(ShrinkState& state)
      : state_(state), worst_(state.best()), depth_(state.depth()), first_evaluation_(state.evaluations()) {}

  Case run() {
    if (!std::isfinite(depth_) || is_abnormal_exit(worst_.expect)) return worst_;
    for (double share = 0.5; share > 0.1; share *= 0.5)
      while (sweep(share)) {
      }
    return worst_;
  }

 private:
  bool sweep(double share) {
    bool climbed = false;
    for (const SpecField& place : state_.spec_fields(worst_.spec))
      for (const double end : {place.low, place.high})
        if (place.is_number && std::isfinite(end)) climbed |= step(place, place.value + share * (end - place.value));
    return climbed;
  }

  bool step(const SpecField& place, double value) {
    Spec candidate = worst_.spec;
    set_spec_field(candidate, place, on_lattice(value, place.steps_per_unit));
    if (candidate == worst_.spec || state_.evaluations() - first_evaluation_ >= kMostEvaluations) return false;
    if (!tried_.insert(print_spec(candidate)).second || !state_.allows(candidate)) return false;
    const std::optional<TrialResult> shown = state_.run(candidate);
    if (!shown || !shown->fails || shown->depth <= depth_ || !std::isfinite(shown->depth)) return false;
    worst_.spec = candidate;
    worst_.expect = shown->expect;
    depth_ = shown->depth;
    return true;
  }

  ShrinkState& state_;
  Case worst_;
  double depth_;
  int first_evaluation_;
  std::set<std::string> tried_;
};

}  // namespace

Case worst_of(ShrinkState& state) { return Climb(state).run(); }

}  // namespace contort
