// The roll of a sole that stands: it comes down on its heel, lies flat, and leaves the ground over its toes. With
// rolling feet a leg reaches farther in front and behind than with flat ones, so that hips need not dip in long strides
// (J. Perry, Gait Analysis, 1992: heel, ankle and forefoot rockers).
#pragma once

#include "model/motion/legs.h"

namespace contort {

// The times at which a sole rolls, as fractions of a stance or a swing, [0, 1].
struct RollTimes {
  double heel_rises = 0.5;   // begin of the heel's rise in the stance
  double heel_peaks = 0.0;   // heel's highest angle in the swing: the foot continues to turn in the air
  double heel_level = 0.75;  // heel level again in the swing; later than heel_peaks
  double toes_rise = 0.6;    // begin of the toes' rise in the swing
  double toes_flat = 0.25;   // toes flat again in the stance
};

// Returns fractions of the largest angles, in [0, 1]. `stance` is the fraction of the stance that is over, [0, 1];
// `swing` that of the swing, 0 while the foot stands; `duty`, (0, 1), is the share of the cycle in which it stands.
// Neither jumps where a stance begins or ends.
double heel_rise(const RollTimes& times, double duty, double stance, double swing);
double toe_rise(const RollTimes& times, double stance, double swing);

// Converts the place of a flat sole to that of a rolling one: the heel is raised about the footprint's front end, the
// toes about its rear end. No point of the sole becomes lower. Angles >= 0.
Rigid rolled_sole(const Leg& leg, double heel_up_rad, double toes_up_rad);

// The point on which a sole stands, in its own frame: the middle of its lower end, or its origin where it lies flat.
Vec3 lower_end_m(const Leg& leg, const Rigid& world_from_sole);

}  // namespace contort
