#include "generator/motion/gait_params.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/foot_roll.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kGravity_m_s2 = 9.81;

GaitParams params_for(std::span<const Leg> legs, double speed_m_s, double heading_rad, double stride_per_leg) {
  GaitParams params;
  const double length_m = least_length_m(legs);
  params.speed_m_s = speed_m_s, params.heading_rad = heading_rad;
  const double root_of_froude = speed_m_s / std::sqrt(kGravity_m_s2 * length_m);
  // Strides grow with the square root of dimensionless speed (Alexander 1989: stride / leg about 2.3 Fr^0.3).
  const double stride_m = stride_per_leg * length_m * std::sqrt(std::max(root_of_froude, 0.04));
  params.cycle_s = stride_m / std::max(speed_m_s, 0.05);
  params.lift_m = 0.08 * length_m;
  params.lower_m = 0.03 * length_m;
  return params;
}

// The distance by which the hips must be below their height at rest for every leg to bend a little still at the ends of
// its stance, when its foot is half of the stance's way in front or behind. Near straight, a knee turns very fast for a
// small step.
double lower_for(std::span<const Leg> legs, double stance_m) {
  constexpr double kBent = 0.97;
  double lower_m = 0.0;
  for (const Leg& leg : legs) {
    const double up_m = leg.hip_m.y - leg.sole_from_ankle.y;
    const double along_m = std::fabs(leg.hip_m.z - leg.home_m.z - leg.sole_from_ankle.z) + 0.5 * stance_m;
    const double reach_m = kBent * leg.length_m;
    const double room = reach_m * reach_m - along_m * along_m;
    lower_m = std::max(lower_m, up_m - std::sqrt(std::max(room, 0.5 * reach_m * reach_m)));
  }
  return lower_m;
}

// The same for one leg whose rolled sole is so far in front of its home.
double lower_for(const Leg& leg, double ahead_m, const Rigid& flat_from_rolled) {
  constexpr double kBent = 0.985;
  const Vec3 ankle = leg.home_m + Vec3(0.0, 0.0, ahead_m) + flat_from_rolled * leg.sole_from_ankle;
  const double reach_m = kBent * leg.length_m, along_m = ankle.z - leg.hip_m.z;
  return leg.hip_m.y - ankle.y - std::sqrt(std::max(reach_m * reach_m - along_m * along_m, 0.5 * reach_m * reach_m));
}

// The distance by which hips must be lower at their lowest than over a standing foot, so that no leg is stretched where
// it reaches farthest: in front when its swing has all but ended, behind when it leaves the ground.
double dip_for(std::span<const Leg> legs, const GaitParams& params) {
  constexpr double kArrives = 0.88;  // of the swing
  const double stride_m = params.speed_m_s * params.cycle_s, stance_m = params.duty * stride_m;
  const double early = (1.0 - kArrives) * (1.0 - params.duty);  // of the cycle, before it stands
  const double in_front = root_beat(params, -early), behind = root_beat(params, params.duty);
  double dip_m = 0.0;
  for (const Leg& leg : legs) {
    const Rigid heel_first = rolled_sole(leg, 0.0, params.toes_up_rad * toe_rise(0.0, kArrives));
    const Rigid toes_last = rolled_sole(leg, params.heel_up_rad, 0.0);
    const double front_m = params.under * stance_m + early * stride_m, back_m = (params.under - 1.0) * stance_m;
    dip_m = std::max({dip_m, (lower_for(leg, front_m, heel_first) - params.lower_m) / in_front,
                      (lower_for(leg, back_m, toes_last) - params.lower_m) / behind});
  }
  return dip_m;
}

// Animals' legs are many, bear more of the time, and step slowly (Hildebrand 1968).
GaitParams walk_on_many(std::span<const Leg> legs, double speed_m_s, double heading_rad) {
  GaitParams params = params_for(legs, speed_m_s, heading_rad, 1.9);
  params.duty = 0.66;
  params.lower_m = lower_for(legs, params.duty * params.cycle_s * speed_m_s);
  return params;
}

// Feet roll forward, the more the longer the stance is, up to 0.8 of a leg; sideways and backward they stay flat. Angles,
// and where the hips are, were chosen so that human and mech walk up to 1.4 and 1.3 m/s within their joints' speeds.
GaitParams walk_on_two(std::span<const Leg> legs, double speed_m_s, double heading_rad) {
  const double length_m = least_length_m(legs), forward = std::max(0.0, det::cos(heading_rad));
  GaitParams params = params_for(legs, speed_m_s, heading_rad, 1.7 + 0.3 * forward);
  params.duty = 0.62;
  const double roll = forward * std::min(1.0, params.duty * params.cycle_s * speed_m_s / (0.8 * length_m));
  params.heel_up_rad = roll * 42.0 * kRadPerDeg;
  params.toes_up_rad = roll * 15.0 * kRadPerDeg;
  params.under = 0.5 - 0.06 * roll;
  params.lower_m = (0.03 - 0.01 * forward) * length_m;
  params.bounce_m = -forward * std::min(dip_for(legs, params), 0.05 * length_m);
  return params;
}

}  // namespace

double least_length_m(std::span<const Leg> legs) {
  double least = 1e9;
  for (const Leg& leg : legs) least = std::min(least, leg.length_m);
  return legs.empty() ? 1.0 : least;
}

int row_count(std::span<const Leg> legs) {
  int rows = 1;
  for (const Leg& leg : legs) rows = std::max(rows, leg.row + 1);
  return rows;
}

double root_beat(const GaitParams& params, double cycles) {
  return 0.5 - 0.5 * det::cos(4.0 * kPi * (cycles - params.under * params.duty));
}

GaitParams walk_params(std::span<const Leg> legs, double speed_m_s, double heading_rad) {
  return legs.size() > 2 ? walk_on_many(legs, speed_m_s, heading_rad) : walk_on_two(legs, speed_m_s, heading_rad);
}

GaitParams run_params(std::span<const Leg> legs, double speed_m_s, double heading_rad) {
  GaitParams params = params_for(legs, speed_m_s, heading_rad, 1.7);
  params.trot = true;
  params.duty = legs.size() > 2 ? 0.45 : 0.4;
  params.lift_m *= 1.5;
  params.lower_m *= 1.5;
  params.bounce_m = 0.03 * least_length_m(legs);
  return params;
}

}  // namespace contort
