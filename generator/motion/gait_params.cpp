#include "generator/motion/gait_params.h"

#include <algorithm>
#include <cmath>

#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kGravity_m_s2 = 9.81;
constexpr double kTurnOfMany_rad = 36.0 * kRadPerDeg;    // in a cycle, of a body with several rows of legs
constexpr double kTurnOnTheSpot_rad = 30.0 * kRadPerDeg;  // nothing takes feet out of each other's way there
constexpr double kSidestep = 0.25;  // the longest stride sideways, of a leg

// The part of a heading to which the body turns; over what is left it goes sideways or backward. Sidesteps are slow, or
// feet would cross; people walk backward at about half of their speed.
double turn_for(std::span<const Leg> legs, double speed_m_s, double heading_rad) {
  constexpr double kSideways = 0.13, kBackward = 0.29;  // the square roots of Froude numbers: 0.4 and 0.85 m/s for people
  constexpr double kBehind_rad = 0.75 * kPi;
  const double relative = root_of_froude(legs, speed_m_s);
  if (relative <= kSideways) return 0.0;
  if (relative > kBackward || std::fabs(heading_rad) < kBehind_rad) return heading_rad;
  return wrap_angle(heading_rad + kPi);
}

GaitParams params_for(std::span<const Leg> legs, double speed_m_s, double heading_rad, double stride_per_leg) {
  GaitParams params;
  const double length_m = least_length_m(legs);
  params.speed_m_s = speed_m_s, params.heading_rad = heading_rad;
  // Strides grow with the square root of dimensionless speed (Alexander 1989: stride / leg about 2.3 Fr^0.3).
  const double stride_m = stride_per_leg * length_m * std::sqrt(std::max(root_of_froude(legs, speed_m_s), 0.04));
  params.cycle_s = stride_m / std::max(speed_m_s, 0.05);
  const double sideways_m = stride_m * std::fabs(det::sin(heading_rad));
  params.cycle_s *= std::min(1.0, kSidestep * length_m / std::max(sideways_m, 1e-9));
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

double heel_up_at_lift_rad(const GaitParams& params) {
  return params.heel_up_rad * heel_rise(params.roll, params.duty, 1.0, 0.0);
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
    const Rigid heel_first = rolled_sole(leg, 0.0, params.toes_up_rad * toe_rise(params.roll, 0.0, kArrives));
    const Rigid toes_last = rolled_sole(leg, heel_up_at_lift_rad(params), 0.0);
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
  params.turn_of_cycle_rad = kTurnOfMany_rad;
  params.lower_m = lower_for(legs, params.duty * params.cycle_s * speed_m_s);
  return params;
}

// Feet roll forward, the more the longer the stance is, up to 0.8 of a leg; sideways and backward they stay flat. The
// numbers were searched for curves of hip, knee and ankle like those of people (CMU 02_01, 12_01, DeepMimic walk) and
// for walks of human and mech up to 2 m/s within their joints' speeds (docs/internals/gait.md).
GaitParams walk_on_two(std::span<const Leg> legs, double speed_m_s, double heading_rad, double roll_share) {
  const double length_m = least_length_m(legs), rolling = roll_share * std::max(0.0, det::cos(heading_rad));
  const auto mixed = [&](double flat, double rolled) { return flat + rolling * (rolled - flat); };
  const double relative = root_of_froude(legs, speed_m_s);
  const double fast = std::clamp((relative - 0.42) / 0.24, 0.0, 1.0);  // 1 where people run
  GaitParams params = params_for(legs, speed_m_s, heading_rad, mixed(1.7, 2.35 - 0.065 * fast));
  params.duty = mixed(0.62, 0.6) - 0.13 * fast;
  const double stance = params.duty * params.cycle_s * speed_m_s / length_m;
  const double roll = rolling * std::min(1.0, stance / 0.8);
  params.heel_up_rad = roll * (59.4 - 20.0 * fast) * kRadPerDeg;
  params.toes_up_rad = roll * (16.8 + 9.4 * fast) * kRadPerDeg;
  params.roll = {.heel_rises = 0.68, .heel_peaks = 0.259, .heel_level = 0.709, .toes_rise = 0.51, .toes_flat = 0.276};
  params.under = params.beat = 0.5 - (0.13 - 0.064 * fast) * roll;
  params.lift_m = mixed(0.08, 0.069 + 0.015 * fast) * length_m;
  params.rise = mixed(0.25, 0.5), params.fall = mixed(0.25, 0.286 - 0.04 * fast);
  params.late = (0.68 * fast - 0.4) * rolling;
  params.lower_m = mixed(0.03, 0.0172 + 0.036 * fast) * length_m;
  // Arms swing by 30 degrees in all at 1.2 m/s (CMU 02_01), against the legs also in a walk backward.
  params.arm_swing_rad = std::min(1.3, relative / 0.4) * 15.0 * kRadPerDeg * det::cos(heading_rad);
  params.arm_back_rad = 5.0 * kRadPerDeg, params.elbow_rad = 15.0 * kRadPerDeg;
  params.bounce_m = -rolling * std::min(dip_for(legs, params), (0.032 + 0.062 * fast) * length_m);
  return params;
}

GaitParams run_on_many(std::span<const Leg> legs, double speed_m_s) {
  GaitParams params = params_for(legs, speed_m_s, 0.0, 1.7);
  params.duty = 0.45;
  params.turn_of_cycle_rad = kTurnOfMany_rad;
  params.lift_m *= 1.5;
  params.lower_m *= 1.5;
  params.bounce_m = 0.03 * least_length_m(legs);
  return params;
}

// People keep the cadence of 0.8 sqrt(g / l) steps a second when they run, and stand for less of it the faster they are
// (39 % at 2.5 m/s, 30 % at 4 m/s). The other numbers were searched for curves of hip, knee and ankle like those of
// people (CMU 02_03, DeepMimic run) and for runs of human and mech within their joints' speeds.
GaitParams run_on_two(std::span<const Leg> legs, double speed_m_s, double roll_share) {
  const double length_m = least_length_m(legs), relative = root_of_froude(legs, speed_m_s);
  GaitParams params;
  params.speed_m_s = speed_m_s;
  params.cycle_s = 2.0 / (0.807 * std::sqrt(kGravity_m_s2 / length_m));
  params.duty = std::clamp(0.386 - 0.351 * (relative - 0.83), 0.22, 0.42);
  params.under = params.beat = 0.253;
  const double brisk = roll_share * std::min(1.0, relative / 0.85);
  params.heel_up_rad = brisk * 64.0 * kRadPerDeg;
  params.toes_up_rad = brisk * 14.4 * kRadPerDeg;
  params.roll = {.heel_rises = 0.265, .heel_peaks = 0.257, .heel_level = 0.85, .toes_rise = 0.629, .toes_flat = 0.299};
  params.lift_m = (0.1 + 0.165 * brisk) * length_m;
  params.rise = 0.384, params.fall = 0.119, params.late = -1.04;
  params.arm_swing_rad = 28.0 * kRadPerDeg, params.arm_back_rad = 15.0 * kRadPerDeg;  // CMU 02_03: -53 to 8 degrees
  params.elbow_rad = 85.0 * kRadPerDeg;
  params.bounce_m = 0.076 * length_m;
  params.lean_rad = 12.0 * kRadPerDeg * std::min(1.0, relative / 1.3);  // the trunk of DeepMimic's runner: 21 to 33 degrees
  const double stance_m = params.duty * params.cycle_s * speed_m_s;
  double lower_m = 0.095 * length_m;
  for (const Leg& leg : legs) {
    const Rigid heel_first = rolled_sole(leg, 0.0, params.toes_up_rad);
    const Rigid toes_last = rolled_sole(leg, heel_up_at_lift_rad(params), 0.0);
    lower_m = std::max({lower_m, lower_for(leg, params.under * stance_m, heel_first),
                        lower_for(leg, (params.under - 1.0) * stance_m, toes_last)});
  }
  params.lower_m = std::min(lower_m, 0.2 * length_m);
  return params;
}

// The numbers of the next two functions were searched for walks of human and mech from 0.4 to 1.5 m/s and runs of 1.5 to
// 5 m/s.

// Steps are shorter and quicker, because a leg that is far from the hips needs much effort, and legs swing for longer.
// A heel is lifted when the other foot has landed: an ankle is too weak to carry all of the weight on the toes. Backward,
// on flat feet, legs swing for still longer, or the hips of human would need a fifth more than their strength.
void spare_walker(GaitParams& params) {
  params.cycle_s *= 0.93, params.duty -= 0.06, params.lift_m *= 0.8;
  const double backward = std::max(0.0, -det::cos(params.heading_rad));
  params.cycle_s *= 1.0 + 0.08 * backward, params.duty -= 0.05 * backward;
  params.heel_up_rad *= 0.7, params.roll.heel_rises = std::max(params.roll.heel_rises, 0.82);
  params.rise = std::max(params.rise, 0.52);
  params.turn_of_cycle_rad *= 0.6;
}

// One foot is always on the ground, because a root that starts or stops does not bounce enough to fly, and the root is
// lowest near the middle of the stance: then the ground's force is least while feet change.
void spare_runner(GaitParams& params) {
  params.trot = false;
  params.cycle_s *= 1.2, params.duty = 0.53, params.under = 0.3, params.beat = 0.44;
  params.bounce_m *= 0.5, params.lower_m *= 0.8;
  params.heel_up_rad *= 0.6, params.roll.heel_rises = 0.78;
  params.rise = 0.48, params.acceleration_m_s2 = 0.7;
  params.wait = 0.03, params.turn_of_cycle_rad *= 0.35;
}

}  // namespace

double root_of_froude(std::span<const Leg> legs, double speed_m_s) {
  return speed_m_s / std::sqrt(kGravity_m_s2 * least_length_m(legs));
}

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
  return 0.5 - 0.5 * det::cos(4.0 * kPi * (cycles - params.beat * params.duty));
}

GaitParams walk_params(std::span<const Leg> legs, double speed_m_s, double heading_rad, const Pace& pace) {
  const double slower_m_s = pace.speed * speed_m_s;
  const double turn_rad = turn_for(legs, slower_m_s, heading_rad), left_rad = heading_rad - turn_rad;
  GaitParams params = legs.size() > 2 ? walk_on_many(legs, slower_m_s, left_rad)
                                      : walk_on_two(legs, slower_m_s, left_rad, pace.roll);
  params.turn_rad = turn_rad;
  return params;
}

GaitParams run_params(std::span<const Leg> legs, double speed_m_s, double heading_rad, const Pace& pace) {
  const double slower_m_s = pace.speed * speed_m_s;
  GaitParams params = legs.size() > 2 ? run_on_many(legs, slower_m_s) : run_on_two(legs, slower_m_s, pace.roll);
  params.trot = true;
  params.turn_rad = turn_for(legs, slower_m_s, heading_rad);
  params.heading_rad = heading_rad - params.turn_rad;
  return params;
}

void spare_strength(std::span<const Leg> legs, GaitParams& params) {
  const bool runs = params.duty < 0.5;
  params.acceleration_m_s2 = runs && legs.size() > 2 ? 1.5 : 0.9;
  params.leads = 0.5;
  params.rise = std::max(params.rise, 0.5);
  if (legs.size() <= 2 && runs) spare_runner(params);
  if (legs.size() <= 2 && !runs) spare_walker(params);
  params.fall = 1.0 - params.rise;
}

// The cadence of a quick walk, 1.1 sqrt(g / l) steps a cycle of two. The foot on the side of the turn goes first.
GaitParams turn_params(std::span<const Leg> legs, double turn_rad, double pace) {
  GaitParams params = walk_params(legs, 0.0, 0.0);
  const double length_m = least_length_m(legs);
  params.cycle_s = 2.6 * std::sqrt(length_m / kGravity_m_s2) / pace;
  params.lift_m = 0.06 * length_m;
  params.arm_swing_rad = params.arm_back_rad = params.elbow_rad = 0.0;
  params.turn_rad = turn_rad;
  params.turn_of_cycle_rad = kTurnOnTheSpot_rad;
  params.lead = turn_rad > 0.0 ? 1 : 0;
  return params;
}

}  // namespace contort
