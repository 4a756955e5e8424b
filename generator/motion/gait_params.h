// The parameters of a gait.
#pragma once

#include <span>

#include "generator/motion/foot_roll.h"
#include "model/motion/legs.h"

namespace contort {

struct GaitParams {
  double speed_m_s = 1.0;    // >= 0, of the root; 0 stands
  double heading_rad = 0.0;  // of travel, from where the body faces at that time
  double turn_rad = 0.0;     // of the body, while it starts
  double turn_of_cycle_rad = 40.0 * kRadPerDeg;  // > 0: of the body in a cycle, at most
  double cycle_s = 1.0;      // > 0, between two steps of one foot
  double duty = 0.6;         // (0, 1): the share of the cycle in which a foot stands
  double under = 0.5;        // (0, 1): of the stance, when the hips have come over the foot
  int lead = 0;              // the side that stands when it begins: 0 left, 1 right
  bool trot = false;         // run: legs cross-wise together; else rows one after another
  double acceleration_m_s2 = 2.2;  // of the root on average, from rest to its speed and back
  double leads = 0.0;        // [0, 1]: by how much of what a pendulum would ask the hips are ahead of the feet meanwhile
  double lift_m = 0.08;      // of a swinging foot, at least
  double lower_m = 0.0;      // the root below its height at rest
  double bounce_m = 0.0;     // of the root, twice in a cycle: up between the feet (run), or down there where < 0 (walk)
  double lean_rad = 0.0;     // of the root, forward
  double heel_up_rad = 0.0;  // >= 0, of a sole about its toes at most
  double toes_up_rad = 0.0;  // >= 0, of a sole that comes down on its heel
  RollTimes roll;
  double arm_swing_rad = 0.0;  // of the arms, to either side of their middle; 0: they hang
  double arm_back_rad = 0.0;   // of this middle, behind how they hang
  double elbow_rad = 0.0;      // of the elbows, more than at rest
  double rise = 0.25;        // (0, 1): the share of a swing in which the foot gets as fast as it is,
  double fall = 0.25;        // and in which it slows down; together at most 1
  double late = 0.0;         // [-2, 2]: by how much it is lifted more in the second half of its swing than in the first
};

// The shares of a requested gait that are made, [0, 1].
struct Pace {
  double speed = 1.0;  // 0: it stands
  double roll = 1.0;   // between flat feet with short steps, 0, and the full roll; runners lift their feet less, too
  bool operator==(const Pace&) const = default;
};

// Sensible parameters for a speed on these legs: longer legs step more slowly, as pendulums do (Froude number).
// `heading_rad` is the way from where the character faces at first. It turns there, but for walks that are slow enough
// to be made sideways or backward.
GaitParams walk_params(std::span<const Leg> legs, double speed_m_s, double heading_rad, const Pace& pace = {});
GaitParams run_params(std::span<const Leg> legs, double speed_m_s, double heading_rad, const Pace& pace = {});

// Makes a gait one that strength and balance allow: it starts and stops slowly, with feet behind and ahead of the hips
// meanwhile, and feet in the air get faster and slower over all of their way.
void spare_strength(GaitParams& params);

// Steps on the spot while the body turns, to the left where `turn_rad` > 0. `pace`, in (0, 1]: a share of the usual cadence.
GaitParams turn_params(std::span<const Leg> legs, double turn_rad, double pace);

// The share of the bounce, [0, 1], at so many cycles after a stance began: 0 where the hips are over the foot.
double root_beat(const GaitParams& params, double cycles);

// v / sqrt(g l) with the shortest leg's length l.
double root_of_froude(std::span<const Leg> legs, double speed_m_s);

double least_length_m(std::span<const Leg> legs);  // 1 where there is none
int row_count(std::span<const Leg> legs);            // at least 1

}  // namespace contort
