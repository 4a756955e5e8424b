#include "generator/motion/gait.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/foothold.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kGap = 0.9;    // of the gap at home: as near as feet come to each other sideways
constexpr double kSoft = 0.010;  // of the shortest leg: before its legs are that short of straight, hips go down
constexpr double kBend = 0.005;  // of a moving leg's length: a knee never snaps straight
constexpr double kNothing_m = 1e-9;

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

// max(x, 0), but a parabola where |x| < width: never less, and without a kink. x >= -width; width >= 0.
double soft_excess(double x, double width) {
  if (x >= width) return x;
  return (x + width) * (x + width) / (4.0 * width);
}

// The share by which a course has begun, or has not ended yet: eased over half a cycle, [0, 1].
double half_cycle_share(const GaitParams& params, double time_s) {
  return minimum_jerk(std::clamp(time_s / (0.5 * params.cycle_s), 0.0, 1.0));
}

}  // namespace

bool is_of_leg(std::span<const Leg> legs, int part) {
  return std::ranges::any_of(legs, [part](const Leg& leg) { return leg.part == part || leg.foot_part == part; });
}

double freedom_of(const GaitFrame& frame, std::span<const Leg> legs, const Environment& environment, int part) {
  constexpr double kFree_m = 0.05;  // above the ground
  for (std::size_t leg = 0; leg < legs.size(); ++leg) {
    if (legs[leg].part != part && legs[leg].foot_part != part) continue;
    const Rigid& sole = frame.feet[leg].world_from_sole;
    const Vec3 lowest_m = sole * lower_end_m(legs[leg], sole);  // a foot with its heel up still stands on its toes
    const double height_m = lowest_m.y - environment.height_at(lowest_m.x, lowest_m.z);
    return minimum_jerk(std::clamp(height_m / kFree_m, 0.0, 1.0));
  }
  return 1.0;
}

void Gait::begin(const Character& character, std::span<const Leg> legs, const Environment& environment,
                 const Rigid& world_from_start, std::span<const Rigid> seen_soles) {
  character_ = &character, legs_ = legs, environment_ = &environment;
  world_from_start_ = world_from_start;
  whole_turn_.reset();
  steps_.fill({});
  for (std::size_t i = 0; i < legs.size(); ++i)
    first_soles_[i] =
        first_sole(environment, legs[i], world_from_start, i < seen_soles.size() ? &seen_soles[i] : nullptr);
}

Vec3 Gait::direction(const GaitParams& params, double turned_rad) const {
  const det::SinCos heading = det::sincos(params.heading_rad + turned_rad);
  return world_from_start_.q * Vec3(heading.sin, 0.0, heading.cos);
}

// The way while the body turns, by Simpson's rule: it goes where it faces, or at its heading to that.
Vec3 Gait::turning_way(const GaitParams& params, const GaitTiming& timing, double time_s) const {
  constexpr int kSteps = 16;
  const double step_s = time_s / kSteps;
  Vec3 sum(0.0);
  for (int n = 0; n <= kSteps; ++n) {
    const double weight = n == 0 || n == kSteps ? 1.0 : n % 2 == 1 ? 4.0 : 2.0;
    const double t = n * step_s;
    sum += weight * timing.speed_m_s(t) * direction(params, timing.turn_rad() * timing.turned(t));
  }
  return sum * (step_s / 3.0);
}

// The way of the whole turn: found once, for one course has one turn.
const Vec3& Gait::whole_turn(const GaitParams& params, const GaitTiming& timing) const {
  if (!whole_turn_) whole_turn_ = turning_way(params, timing, timing.turn_s());
  return *whole_turn_;
}

// The middle of the feet at home, in the figure's frame.
Vec3 Gait::middle() const {
  Vec3 sum(0.0);
  for (const Leg& leg : legs_) sum.z += leg.home_m.z;
  return sum / std::max<double>(1.0, static_cast<double>(legs_.size()));
}

Rigid Gait::course(const GaitParams& params, const GaitTiming& timing, double time_s) const {
  const double t = std::max(0.0, time_s), turning_s = std::min(t, timing.turn_s());
  const Vec3 curve = turning_s <= 0.0       ? Vec3(0.0)
                     : t < timing.turn_s() ? turning_way(params, timing, t)
                                           : whole_turn(params, timing);
  const double straight_m = timing.travelled_m(t) - timing.travelled_m(turning_s);
  const double turned_rad = timing.turn_rad() * timing.turned(t);
  if (params.speed_m_s == 0.0) {  // about the middle of the feet, so that all of them step equally far
    const Quat turned = axis_angle(Vec3(0, 1, 0), turned_rad);
    return world_from_start_ * Rigid{turned, middle() - turned * middle()};
  }
  return {world_from_start_.q * axis_angle(Vec3(0, 1, 0), turned_rad),
          world_from_start_.p_m + curve + straight_m * direction(params, turned_rad)};
}

// A foothold without care for the other feet: the home place under the course in the middle of the stance, behind it
// while the figure gets faster and ahead while it gets slower, or it would tip.
Rigid Gait::nominal(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int step) const {
  if (timing.lifted_s(leg, step - 1) < 0.0) return first_soles_[static_cast<std::size_t>(&leg - legs_.data())];
  const double middle_s = timing.middle_s(leg, step);
  Rigid at = course(params, timing, middle_s);
  at.p_m -= timing.leads_m(middle_s) * direction(params, timing.turn_rad() * timing.turned(middle_s));
  return {at.q, home_of(leg, at)};
}

// By how much two feet of a row, one of which comes down beside the other, would be nearer sideways than at home, m.
double Gait::missing_gap_m(const Leg& leg, const Rigid& foot, const Leg& other, const Rigid& beside) const {
  const double home_gap_m = std::fabs(leg.home_m.x - other.home_m.x);
  const double side = leg.side == 0 ? 1.0 : -1.0;
  const Vec3 apart_m = foot.p_m - beside.p_m;
  const double gap_m =
      std::min(side * (glm::conjugate(foot.q) * apart_m).x, side * (glm::conjugate(beside.q) * apart_m).x);
  return std::max(0.0, kGap * home_gap_m - gap_m);
}

// Feet keep beside each other in turns and sidesteps: both of two that would come too near give way, by half each, or
// one all the way where the other stands from the beginning.
double Gait::apart_m(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int step) const {
  if (params.turn_rad == 0.0 && params.heading_rad == 0.0) return 0.0;
  const Rigid foot = nominal(params, timing, leg, step);
  double most_m = 0.0;
  for (const Leg& other : legs_) {
    if (other.row != leg.row || other.side == leg.side) continue;
    const int beside = timing.cycle(other, timing.lands_s(leg, step)).step;
    for (const int s : {beside, beside + 1}) {
      const double share = timing.lifted_s(other, s - 1) < 0.0 ? 1.0 : 0.5;
      most_m = std::max(most_m, share * missing_gap_m(leg, foot, other, nominal(params, timing, other, s)));
    }
  }
  return most_m;
}

// A foot stands where it was first until its first swing begins, and is home again from the step on whose middle comes
// after the end.
Rigid Gait::foothold(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int step) const {
  const Rigid at = nominal(params, timing, leg, step);
  if (timing.lifted_s(leg, step - 1) < 0.0) return at;
  const double apart = apart_m(params, timing, leg, step) * (leg.side == 0 ? 1.0 : -1.0);
  return stand_at(*environment_, leg, at.q, at * Vec3(apart, 0.0, 0.0),
                  direction(params, timing.turn_rad() * timing.turned(timing.middle_s(leg, step))));
}

void Gait::take_step(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int number,
                     Step& step) const {
  if (step.number == number) return;
  step.number = number;
  step.rise = params.rise, step.fall = params.fall, step.late = params.late;
  step.from = foothold(params, timing, leg, number);
  // A swing that began before the course did is not made: the foot stands where it is.
  step.to = timing.lifted_s(leg, number) >= 0.0 ? foothold(params, timing, leg, number + 1) : step.from;
  choose_rolling(*environment_, leg, std::max(params.speed_m_s * params.cycle_s, 1e-6), params.toes_up_rad,
                 foothold(params, timing, leg, number - 1), step);
  choose_swing(*environment_, leg, params.lift_m, step);
}

double Gait::below_rest_m(const Rigid& root) const {
  const double rests_at_m = character_->rest_root().p_m.y + environment_->height_at(root.p_m.x, root.p_m.z);
  return std::max(0.0, rests_at_m - root.p_m.y);
}

// Over the feet, upright or along their slope.
Rigid Gait::root_over(std::span<const Vec3> feet, const Rigid& course, double lower_m) const {
  const Rigid& rest = character_->rest_root();
  double mean_y = 0.0;
  const double count = std::max<double>(1.0, static_cast<double>(legs_.size()));
  for (std::size_t i = 0; i < legs_.size(); ++i) mean_y += feet[i].y / count;
  const Vec3 pivot = middle();  // on the ground between the feet
  const double pitch_rad = row_count(legs_) > 1 ? slope_rad(legs_, feet, mean_y, pivot.z) : 0.0;
  const Quat tilt = axis_angle(Vec3(1, 0, 0), pitch_rad);
  Rigid root{course.q * tilt * rest.q, course * (pivot + tilt * (rest.p_m - pivot))};
  root.p_m.y = (pivot + tilt * (rest.p_m - pivot)).y + mean_y - lower_m;
  return root;
}

// As low as the leg with the longest way needs, without a kink where it begins to need it while it moves.
void Gait::lower_to_reach(std::span<const double> holds, double bend, GaitFrame& frame) const {
  const double soft_m = bend * kSoft * least_length_m(legs_);
  double high_m = -soft_m;
  const Rigid world_from_character = frame.root * inverse(character_->rest_root());
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Vec3 ankle = frame.feet[i].world_from_sole * legs_[i].sole_from_ankle;
    const double reach_m = (1.0 - bend * kBend) * legs_[i].length_m;
    const double over_m = too_high_m(world_from_character * legs_[i].hip_m, ankle, reach_m);
    high_m = std::max(high_m, holds[i] * (over_m + soft_m) - soft_m);
  }
  frame.root.p_m.y -= soft_excess(high_m, soft_m);
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
  frame.root = root_over(feet, world_from_start_, 0.0);
  const double rests_at_m = frame.root.p_m.y;
  lower_to_reach(holds, 0.0, frame);
  if (rests_at_m - frame.root.p_m.y > kNothing_m) frame.short_m = below_rest_m(frame.root);
  frame.stands_at = world_from_start_;
  // From where the legs reach, wherever that is: without a kink.
  frame.root.p_m.y -= lower_share * least_length_m(legs_);
  return frame;
}

// An arm is farthest back when the foot of its own side comes down.
void Gait::swing_arms(const GaitParams& params, const GaitTiming& timing, double time_s, double moving,
                      GaitFrame& frame) const {
  constexpr double kOut_rad = 8.0 * kRadPerDeg;  // so that hands pass the thighs
  if (params.arm_swing_rad == 0.0) return;
  for (const Leg& leg : legs_) {
    const double since = timing.since_landing(leg, time_s);
    frame.arms[static_cast<std::size_t>(leg.side)] = {
        moving * (-params.arm_back_rad - params.arm_swing_rad * det::cos(2.0 * kPi * since)), moving * kOut_rad,
        moving * params.elbow_rad};
  }
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
    // A foot that stays, or has come to stand at the end, holds the hips all the time.
    holds[i] = params.trot && step.bump_m > 0.0 ? 1.0 - moving * (1.0 - hold_of(cycle.swing)) : 1.0;
    feet[i] = straight_way(step, cycle.swing);
    frame.feet[i] = {swung_sole(*environment_, legs_[i], step, cycle, params, moving),
                     cycle.swing == 0.0 || step.bump_m == 0.0};
  }
  swing_arms(params, timing, time_s, moving, frame);
  const double bounce_m =
      params.bounce_m * root_beat(params, time_s / params.cycle_s - params.wait) * timing.step_share(time_s);
  frame.stands_at = course(params, timing, time_s);
  frame.root = root_over(feet, frame.stands_at, moving * (params.lower_m - bounce_m));
  frame.root.q = frame.root.q * axis_angle(Vec3(1, 0, 0), params.lean_rad * timing.step_share(time_s));
  lower_to_reach(holds, moving, frame);
  return frame;
}

}  // namespace contort
