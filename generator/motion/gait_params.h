// The parameters of a gait.
#pragma once

#include <span>

#include "generator/motion/foot_roll.h"
#include "model/motion/legs.h"

namespace contort {

struct GaitParams {
  double speed_m_s = 1.0;    // speed of the root, >= 0; at 0 the figure stands
  double heading_rad = 0.0;  // direction of travel, relative to the direction that the body faces at that time
  double turn_rad = 0.0;     // turn of the body while it starts
  double turn_of_cycle_rad = 40.0 * kRadPerDeg;  // > 0: greatest turn of the body in a cycle
  double cycle_s = 1.0;      // > 0, between two steps of one foot
  double duty = 0.6;         // (0, 1): the fraction of the cycle in which a foot stands
  double under = 0.5;        // (0, 1): the fraction of the stance after which the hips are over the foot
  double wait = 0.0;         // [0, 1 - duty): fraction of a cycle by which all steps come later: weight goes first
  int lead = 0;              // the side that stands when it begins: 0 left, 1 right
  bool trot = false;         // run: legs cross-wise together; else rows one after another
  double acceleration_m_s2 = 2.2;  // mean acceleration of the root, from rest to its speed and back
  double leads = 0.0;        // [0, 1]: lead of the hips over the feet meanwhile, as a fraction of an inverted
                             // pendulum's
  double lift_m = 0.08;      // least lift of a swinging foot
  double lower_m = 0.0;      // depth of the root below its height at rest
  double bounce_m = 0.0;     // twice in a cycle the root goes up between the feet (> 0, run), or down (< 0, walk)
  double beat = 0.5;         // (0, 1): fraction of the stance after which the root is lowest (run) or highest (walk)
  double lean_rad = 0.0;     // forward lean of the root
  double heel_up_rad = 0.0;  // >= 0: greatest angle of a sole about its toes
  double toes_up_rad = 0.0;  // >= 0: angle of a sole that comes down on its heel
  RollTimes roll;
  double arm_swing_rad = 0.0;  // swing of the arms, to either side of their middle; 0: they hang
  double arm_back_rad = 0.0;   // angle of this middle behind the hanging arms
  double elbow_rad = 0.0;      // bend of the elbows in addition to rest
  double rise = 0.25;        // (0, 1): the fraction of a swing in which the foot gains its speed
  double fall = 0.25;        // the fraction in which it slows down; rise + fall <= 1
  double late = 0.0;         // [-2, 2]: additional lift in the second half of the swing, compared with the first half
};

// The fractions of a requested gait that the figure makes, [0, 1].
struct Pace {
  double speed = 1.0;  // 0: it stands
  double roll = 1.0;   // between flat feet with short steps, 0, and the full roll; runners lift their feet less, too
  bool operator==(const Pace&) const = default;
};

// Returns sensible parameters for a speed on these legs: longer legs step more slowly, as pendulums do (Froude number).
// `heading_rad` is relative to the direction that the character faces at first. The character turns there, except in
// walks that are slow enough to go sideways or backward.
GaitParams walk_params(std::span<const Leg> legs, double speed_m_s, double heading_rad, const Pace& pace = {});
GaitParams run_params(std::span<const Leg> legs, double speed_m_s, double heading_rad, const Pace& pace = {});

// Changes a gait to one that strength and balance allow: it starts, stops and turns slowly, with feet behind and ahead
// of the hips meanwhile, and feet in the air get faster and slower over all of their way. Two legs step shorter, lift
// their heels later, and run with a foot on the ground.
void spare_strength(std::span<const Leg> legs, GaitParams& params);

// Returns the gait of steps on the spot while the body turns, to the left if `turn_rad` > 0. `pace`, in (0, 1], is a
// fraction of the usual cadence.
GaitParams turn_params(std::span<const Leg> legs, double turn_rad, double pace);

// Returns the fraction of the bounce, [0, 1], this many cycles after a stance began: 0 at `beat` of the stance.
double root_beat(const GaitParams& params, double cycles);

// v / sqrt(g l) with the shortest leg's length l.
double root_of_froude(std::span<const Leg> legs, double speed_m_s);

double least_length_m(std::span<const Leg> legs);  // 1 if there are no legs
int row_count(std::span<const Leg> legs);            // at least 1

}  // namespace contort
