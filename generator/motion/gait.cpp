#include "generator/motion/gait.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/foothold.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kBend = 0.01;  // of a moving leg's length: a knee never snaps straight

// The weight with which a runner's leg holds the hips down, [0, 1]: none while it swings, when its foot may trail.
double hold_of(double swing) {
  const double off = std::clamp(std::min(swing, 1.0 - swing) / 0.2, 0.0, 1.0);
  return 1.0 - minimum_jerk(off);
}

// The slope of the feet's heights along the character, as a least-squares line about their mean.
double slope_rad(std::span<const Leg> legs, std::span<const Vec3> feet, double mean_y, double mean_z) {
  double zz = 0.0, zy = 0.0;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const double z = legs[i].home_m.z - mean_z;
    zz += z * z, zy += z * (feet[i].y - mean_y);
  }
  return -det::atan2(zy, zz);
}

// The height of a hip above the highest place from which a leg of this length reaches its ankle, m.
double too_high_m(const Vec3& hip, const Vec3& ankle, double reach_m) {
  const double across2 = (hip.x - ankle.x) * (hip.x - ankle.x) + (hip.z - ankle.z) * (hip.z - ankle.z);
  const double up_m = std::sqrt(std::max(reach_m * reach_m - across2, 0.04 * reach_m * reach_m));
  return hip.y - ankle.y - up_m;
}

// The share by which a course has begun, or has not ended yet: eased over half a cycle, [0, 1].
double half_cycle_share(const GaitParams& params, double time_s) {
  return minimum_jerk(std::clamp(time_s / (0.5 * params.cycle_s), 0.0, 1.0));
}

}  // namespace

void Gait::begin(const Character& character, std::span<const Leg> legs, const Environment& environment,
                 const Rigid& world_from_start, std::span<const Rigid> seen_soles) {
  character_ = &character, legs_ = legs, environment_ = &environment;
  world_from_start_ = world_from_start;
  steps_.fill({});
  for (std::size_t i = 0; i < legs.size(); ++i)
    first_soles_[i] =
        first_sole(environment, legs[i], world_from_start, i < seen_soles.size() ? &seen_soles[i] : nullptr);
}

Vec3 Gait::travel(const GaitParams& params, double distance_m) const {
  const det::SinCos heading = det::sincos(params.heading_rad);
  return world_from_start_.q * (distance_m * Vec3(heading.sin, 0.0, heading.cos));
}

// A foot stands where it was first until its first swing begins, and is home again from the step on whose middle comes
// after the end.
Rigid Gait::foothold(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int step) const {
  if (timing.lifted_s(leg, step - 1) < 0.0) return first_soles_[static_cast<std::size_t>(&leg - legs_.data())];
  const Vec3 way = travel(params, timing.travelled_m(timing.middle_s(leg, step)));
  return stand_at(*environment_, leg, world_from_start_.q, home_of(leg, world_from_start_) + way, travel(params, 1.0));
}

void Gait::take_step(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int number,
                     Step& step) const {
  if (step.number == number) return;
  step.number = number;
  step.from = foothold(params, timing, leg, number);
  // A swing that began before the course did is not made: the foot stands where it is.
  step.to = timing.lifted_s(leg, number) >= 0.0 ? foothold(params, timing, leg, number + 1) : step.from;
  choose_rolling(*environment_, leg, std::max(params.speed_m_s * params.cycle_s, 1e-6),
                 foothold(params, timing, leg, number - 1), step);
  choose_swing(*environment_, leg, params.lift_m, step);
}

// Over the feet, upright or along their slope.
Rigid Gait::root_over(std::span<const Vec3> feet, const Vec3& travel_m, double lower_m) const {
  const Rigid& rest = character_->rest_root();
  double mean_y = 0.0, mean_z = 0.0;
  const double count = std::max<double>(1.0, static_cast<double>(legs_.size()));
  for (std::size_t i = 0; i < legs_.size(); ++i) mean_y += feet[i].y / count, mean_z += legs_[i].home_m.z / count;
  const double pitch_rad = row_count(legs_) > 1 ? slope_rad(legs_, feet, mean_y, mean_z) : 0.0;
  const Quat tilt = axis_angle(Vec3(1, 0, 0), pitch_rad);
  const Vec3 pivot(0.0, 0.0, mean_z);  // on the ground between the feet
  Rigid root{world_from_start_.q * tilt * rest.q,
             world_from_start_ * (pivot + tilt * (rest.p_m - pivot)) + travel_m};
  root.p_m.y = (pivot + tilt * (rest.p_m - pivot)).y + mean_y - lower_m;
  return root;
}

// As low as the leg with the longest way needs.
void Gait::lower_to_reach(std::span<const double> holds, double bend, GaitFrame& frame) const {
  double lower_m = 0.0;
  const Rigid world_from_character = frame.root * inverse(character_->rest_root());
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Vec3 ankle = frame.feet[i].world_from_sole * legs_[i].sole_from_ankle;
    const double reach_m = (1.0 - bend * kBend) * legs_[i].length_m;
    lower_m = std::max(lower_m, holds[i] * too_high_m(world_from_character * legs_[i].hip_m, ankle, reach_m));
  }
  frame.root.p_m.y -= lower_m;
}

GaitFrame Gait::stand(double lower_share) {
  constexpr int kHome = -1;  // no step of a course that begins at 0
  GaitFrame frame;
  std::array<Vec3, kMaxLegs> feet;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    if (steps_[i].number != kHome) steps_[i].from = first_soles_[i], steps_[i].number = kHome;
    frame.feet[i].world_from_sole = steps_[i].from;
    feet[i] = steps_[i].from.p_m;
  }
  std::array<double, kMaxLegs> holds;
  holds.fill(1.0);
  frame.root = root_over(feet, Vec3(0.0), 0.0);
  lower_to_reach(holds, 0.0, frame);
  frame.stands_at = world_from_start_;
  // From where the legs reach, wherever that is: without a kink.
  frame.root.p_m.y -= lower_share * least_length_m(legs_);
  return frame;
}

GaitFrame Gait::at(const GaitParams& params, double time_s, double duration_s) {
  GaitFrame frame;
  std::array<Vec3, kMaxLegs> feet;  // on their straight ways, without the lift
  std::array<double, kMaxLegs> holds{};
  const GaitTiming timing(params, legs_, duration_s);
  const double moving = half_cycle_share(params, time_s) * half_cycle_share(params, duration_s - time_s);
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    Step& step = steps_[i];
    const FootCycle cycle = timing.cycle(legs_[i], time_s);
    take_step(params, timing, legs_[i], cycle.step, step);
    holds[i] = params.trot ? hold_of(cycle.swing) : 1.0;
    feet[i] = straight_way(step, cycle.swing);
    frame.feet[i] = {swung_sole(*environment_, legs_[i], step, cycle, params.heel_up_rad * moving,
                                params.toes_up_rad * moving),
                     cycle.swing == 0.0 || step.bump_m == 0.0};
  }
  const double bounce_m = params.bounce_m * root_beat(params, time_s / params.cycle_s) * timing.step_share(time_s);
  const Vec3 way = travel(params, timing.travelled_m(time_s));
  frame.stands_at = {world_from_start_.q, world_from_start_.p_m + way};
  frame.root = root_over(feet, way, moving * (params.lower_m - bounce_m));
  lower_to_reach(holds, moving, frame);
  return frame;
}

}  // namespace contort
