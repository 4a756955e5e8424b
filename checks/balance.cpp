// balance: how far inside the support area the zero moment point is, in motions that dynamics made. A figure that tips,
// falls or flies although its target stands has no such point; fixed distances stand for these states. Frames after a
// blow that is harder than the figure withstands are not judged.
#include <algorithm>

#include "checks/check.h"
#include "checks/fixed_limits.h"
#include "checks/withstands.h"
#include "model/core/index.h"

namespace contort {

namespace {

double margin_of(const Stance& stance) {
  if (stance.footing == Footing::fallen) return kFallen_m;
  if (stance.footing == Footing::tipping) return std::clamp(stance.margin_m, kFallen_m, kTipping_m);
  if (stance.footing == Footing::airborne) return kAirborne_m;
  return std::max(stance.margin_m, kFallen_m);
}

}  // namespace

int balance_subject_count(const Character&) { return 1; }

Subject balance_subject(const Character&, int) { return {"figure", "m"}; }

void balance_measure(const CheckInput& in, MarginFold& fold) {
  const std::vector<Stance>& stances = in.motion.response.stances;
  const std::size_t judged = std::min(stances.size(), at(first_overpowered_frame(in.character, in.motion)));
  for (std::size_t f = 0; f < judged; ++f) {
    const Stance& stance = stances[f];
    const bool flies_as_planned = stance.planned == 0 && stance.footing != Footing::fallen;
    const bool lands_later = stance.standing == 0 && stance.footing == Footing::standing;
    if (!flies_as_planned && !lands_later) fold.report(0, static_cast<int>(f), margin_of(stance));
  }
}

}  // namespace contort
