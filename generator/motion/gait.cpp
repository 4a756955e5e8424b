#include "generator/motion/gait.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/foot_roll.h"
#include "generator/motion/foothold.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kBend = 0.01;          // of a moving leg's length: a knee never snaps straight
constexpr double kClearance_m = 0.015;  // of a swinging foot

// Swing, horizontally: between two margins of its time, so that the foot leaves and meets the ground vertically.
double swing_share(double swing, double margin) {
  return minimum_jerk(std::clamp((swing - margin) / (1.0 - 2.0 * margin), 0.0, 1.0));
}
double swing_bump(double swing) {
  const double left = swing * (1.0 - swing);
  return 16.0 * left * left;
}

double across_m(const Vec3& from, const Vec3& to) {
  return std::sqrt((to.x - from.x) * (to.x - from.x) + (to.z - from.z) * (to.z - from.z));
}

// Toes hang while a foot comes up behind, as far as they have half of its lift above the ground: a foot that stays level
// asks more of its ankle the more the knee bends.
double toes_down_rad(const Leg& leg, double bump_m, double swing) {
  const double toes_m = std::max(leg.high_m.z, 0.01);
  return std::min(0.5 * bump_m / toes_m, kSteepestSole_rad) * swing_bump(swing) * 2.0 * (1.0 - swing);
}

}  // namespace

void Gait::begin(const Character& character, std::span<const Leg> legs, const Environment& environment,
                 const Rigid& world_from_start, std::span<const Rigid> seen_soles) {
  character_ = &character, legs_ = legs, environment_ = &environment;
  world_from_start_ = world_from_start;
  leg_length_m_ = least_length_m(legs);
  rows_ = 1;
  for (const Leg& leg : legs) rows_ = std::max(rows_, leg.row + 1);
  steps_.fill({});
  for (std::size_t i = 0; i < legs.size(); ++i)
    first_soles_[i] = first_sole(legs[i], i < seen_soles.size() ? &seen_soles[i] : nullptr);
}

Rigid Gait::first_sole(const Leg& leg, const Rigid* seen) const {
  constexpr double kStands_m = 0.002;        // nearer to where it would be put, a foot is left as it is
  constexpr double kFarthest = 0.4;          // from home, of the leg's length: about half of a long stride
  const Vec3 home = world_from_start_ * Vec3(leg.home_m.x, 0.0, leg.home_m.z);
  const Vec3 off = seen != nullptr ? seen->p_m - home : Vec3(0.0);
  const double off_m = std::sqrt(off.x * off.x + off.z * off.z);
  if (seen == nullptr || off_m > kFarthest * leg.length_m)
    return stand_at(leg, home, world_from_start_.q * Vec3(0, 0, 1));
  const auto placed_about = [&](const Vec3& on) {
    const Vec3 at = *seen * on - world_from_start_.q * on;
    return put_down(at, foothold_at(*environment_, leg, {world_from_start_.q, at}));
  };
  const Rigid placed = placed_about(Vec3(0.0));
  const Vec3 up_seen = seen->q * Vec3(0, 1, 0), up_placed = placed.q * Vec3(0, 1, 0);
  const bool stands = std::fabs(placed.p_m.y - seen->p_m.y) < kStands_m && glm::dot(up_seen, up_placed) > 0.999;
  return stands ? *seen : placed_about(lower_end_m(leg, *seen));
}

double Gait::phase(const GaitParams& params, const Leg& leg) const {
  const int side = leg.side == params.lead ? 0 : 1;
  if (params.trot) return 0.5 * ((side + leg.row) % 2);
  return 0.5 * side + 0.5 * leg.row / rows_;
}

Gait::Cycle Gait::cycle_of(const GaitParams& params, const Leg& leg, double time_s) const {
  const double cycles = time_s / params.cycle_s + phase(params, leg);
  const double whole = std::floor(cycles + 1e-9);
  const double within = std::max(0.0, cycles - whole);
  const double swing = (within - params.duty) / (1.0 - params.duty);
  return {static_cast<int>(whole), std::min(within / params.duty, 1.0), std::clamp(swing, 0.0, 1.0)};
}

// When a leg's first swing begins.
double Gait::first_lift_s(const GaitParams& params, const Leg& leg) const {
  const double cycles = params.duty - phase(params, leg);
  return (cycles < 0.0 ? cycles + 1.0 : cycles) * params.cycle_s;
}

// It ends a cycle early, so that every foot has the time to come home. It begins so slowly that no foot is left behind
// at home by more than half a stance before its first swing: a way of ramp u^3 with u = lift / ramp, at most.
Gait::Pace Gait::pace_of(const GaitParams& params, double duration_s) const {
  Pace pace{params.speed_m_s, std::max(duration_s - params.cycle_s, 0.5 * duration_s), 0.0, 0.0};
  double lift_s = 0.0;
  for (const Leg& leg : legs_) lift_s = std::max(lift_s, first_lift_s(params, leg));
  const double half_stance_s = 0.5 * params.duty * params.cycle_s;
  const double wanted_s = std::sqrt(lift_s * lift_s * lift_s / half_stance_s);
  pace.up_s = std::min(std::max(wanted_s, 0.6 * params.cycle_s), 0.6 * pace.moving_s);
  pace.down_s = std::min(0.6 * params.cycle_s, pace.moving_s - pace.up_s);
  const double hurry = wanted_s / std::max(pace.up_s, 1e-9);  // above 1 on a way too short for the speed
  if (hurry > 1.0) pace.speed_m_s /= hurry * hurry;
  return pace;
}

// Speed rises and falls along 3u^2 - 2u^3.
double Gait::travelled_m(const Pace& pace, double time_s) {
  const auto ramped = [](double t, double ramp_s) {  // the integral of the rising speed
    const double u = ramp_s > 0.0 ? std::clamp(t / ramp_s, 0.0, 1.0) : 1.0;
    return ramp_s * (u * u * u - 0.5 * u * u * u * u) + std::max(0.0, t - ramp_s);
  };
  const double t = std::clamp(time_s, 0.0, pace.moving_s);
  if (t <= pace.moving_s - pace.down_s) return pace.speed_m_s * ramped(t, pace.up_s);
  const double whole = ramped(pace.moving_s - pace.down_s, pace.up_s) + ramped(pace.down_s, pace.down_s);
  return pace.speed_m_s * (whole - ramped(pace.moving_s - t, pace.down_s));
}

Vec3 Gait::travel(const GaitParams& params, double distance_m) const {
  const det::SinCos heading = det::sincos(params.heading_rad);
  return world_from_start_.q * (distance_m * Vec3(heading.sin, 0.0, heading.cos));
}

Rigid Gait::put_down(const Vec3& at, const Foothold& foothold) const {
  // Pitch about the sole's x, then roll about its z, as small rotations of one vector.
  const Vec3 normal = unit_or(Vec3(-foothold.slope_x, 1.0, -foothold.slope_z), Vec3(0, 1, 0));
  return {world_from_start_.q * shortest_arc(Vec3(0, 1, 0), normal), Vec3(at.x, foothold.height_m, at.z)};
}

// Puts a foot on the ground near a place: among a few places along the way the most even one, the nearer the better.
Rigid Gait::stand_at(const Leg& leg, const Vec3& home_m, const Vec3& direction) const {
  constexpr double kStep_m = 0.02;
  constexpr int kSteps = 12;
  constexpr double kFarther = 0.02;  // unevenness that one metre of detour is worth
  Foothold best;
  Vec3 best_at = home_m;
  double best_cost = 1e9;
  for (int n = 0; n <= 2 * kSteps; ++n) {
    const int steps = n % 2 == 0 ? -n / 2 : (n + 1) / 2;  // 0, 1, -1, 2, -2 …
    const Vec3 at = home_m + steps * kStep_m * direction;
    const Foothold foothold = foothold_at(*environment_, leg, {world_from_start_.q, at});
    const double cost = foothold.unevenness_m + kFarther * kStep_m * std::abs(steps);
    if (cost < best_cost - 1e-9) best = foothold, best_at = at, best_cost = cost;
    if (environment_->is_level()) break;
  }
  return put_down(best_at, best);
}

// A foot stands where it was first until its first swing begins, and is home again from the step on whose middle comes
// after the end.
Rigid Gait::foothold(const GaitParams& params, const Pace& pace, const Leg& leg, int step) const {
  const double lifted_s = (step - 1 + params.duty - phase(params, leg)) * params.cycle_s;
  const double middle_s = (step + params.under * params.duty - phase(params, leg)) * params.cycle_s;
  if (lifted_s < 0.0) return first_soles_[static_cast<std::size_t>(&leg - legs_.data())];
  const Vec3 home =
      world_from_start_ * Vec3(leg.home_m.x, 0.0, leg.home_m.z) + travel(params, travelled_m(pace, middle_s));
  return stand_at(leg, home, travel(params, 1.0));
}

// How high a swing with these margins must be lifted over its straight way so that toes, heel and middle clear the
// ground.
double Gait::clear_bump(const Leg& leg, const Step& step, double margin) const {
  constexpr int kSamples = 96;  // a centimetre of way each: no edge is stepped over unseen
  const Vec3 way = step.to.p_m - step.from.p_m;
  double bump_m = 0.0;
  for (int n = 1; n < kSamples; ++n) {
    const double swing = static_cast<double>(n) / kSamples;
    const double share = swing_share(swing, margin);
    if (share <= 0.0 || share >= 1.0) continue;
    const Rigid sole{slerp_short(step.from.q, step.to.q, share), step.from.p_m + share * way};
    for (int i = 0; i < kAcross; i += 2)
      for (int j = 0; j < kLong; j += 3) {
        const Vec3 at = sole * footprint_point(leg, i, j);
        const double missing_m = environment_->height_at(at.x, at.z) - at.y;
        const double bump = swing_bump(swing);
        if (missing_m > -kClearance_m * bump) bump_m = std::max(bump_m, missing_m / bump + kClearance_m);
      }
  }
  return bump_m;
}

// The gentlest swing that clears the ground without being lifted much higher than needed: where a riser is near, the
// foot goes up first and forward then.
void Gait::choose_swing(const Leg& leg, double lift_m, Step& step) const {
  constexpr double kMargins[] = {0.05, 0.1, 0.15, 0.2, 0.25, 0.3};
  const Vec3 way = step.to.p_m - step.from.p_m;
  const double horizontal_m = across_m(step.from.p_m, step.to.p_m);
  // Lower on a short way, but a step of a centimetre scrapes if it is not lifted by as much.
  const double least_m = std::max(lift_m * std::min(1.0, horizontal_m / 0.15), std::min(kClearance_m, horizontal_m));
  step.margin = kMargins[0], step.bump_m = least_m;
  if (environment_->is_level() || horizontal_m < 1e-6) return;
  const double enough_m = 2.0 * lift_m + 0.5 * std::fabs(way.y);
  step.bump_m = 1e9;
  for (const double margin : kMargins) {
    const double bump_m = std::max(least_m, clear_bump(leg, step, margin));
    if (bump_m < step.bump_m) step.margin = margin, step.bump_m = bump_m;
    if (step.bump_m <= enough_m) break;
  }
  step.bump_m = std::min(step.bump_m, 0.5 * leg.length_m);  // higher no leg gets
}

void Gait::take_step(const GaitParams& params, const Pace& pace, const Leg& leg, int number, Step& step) const {
  if (step.number == number) return;
  step.number = number;
  step.from = foothold(params, pace, leg, number);
  // A swing that began before the course did is not made: the foot stands where it is.
  const bool swings = (number + params.duty - phase(params, leg)) * params.cycle_s >= 0.0;
  step.to = swings ? foothold(params, pace, leg, number + 1) : step.from;
  choose_rolling(params, leg, foothold(params, pace, leg, number - 1), step);
  choose_swing(leg, params.lift_m, step);
}

// 0 where what is above a sole's end would turn into a riser.
double Gait::room_to_roll(const Leg& leg, const Rigid& world_from_sole, double end_m, double beyond_m) const {
  if (environment_->is_level()) return 1.0;
  for (const double x : {leg.low_m.x, 0.0, leg.high_m.x}) {
    const Vec3 at = world_from_sole * Vec3(x, 0.0, end_m + beyond_m);
    if (environment_->height_at(at.x, at.z) > at.y + kClearance_m) return 0.0;
  }
  return 1.0;
}

// Less on a way shorter than a stride.
void Gait::choose_rolling(const GaitParams& params, const Leg& leg, const Rigid& before, Step& step) const {
  const double stride_m = std::max(params.speed_m_s * params.cycle_s, 1e-6), beyond_m = 0.7 * leg.sole_from_ankle.y;
  const double came = std::min(1.0, across_m(before.p_m, step.from.p_m) / stride_m);
  const double goes = std::min(1.0, across_m(step.from.p_m, step.to.p_m) / stride_m);
  step.landed_up = came * room_to_roll(leg, step.from, leg.low_m.z, -beyond_m);
  step.leaves_up = goes * room_to_roll(leg, step.from, leg.high_m.z, beyond_m);
  step.lands_up = goes * room_to_roll(leg, step.to, leg.low_m.z, -beyond_m);
}

Rigid Gait::sole_roll(const GaitParams& params, const Leg& leg, const Step& step, const Cycle& cycle) {
  const double toes_up = cycle.swing > 0.0 ? step.lands_up : step.landed_up;
  return rolled_sole(leg, params.heel_up_rad * step.leaves_up * heel_rise(cycle.stance, cycle.swing),
                     params.toes_up_rad * toes_up * toe_rise(cycle.stance, cycle.swing));
}

// How much the leg of a runner holds the hips down: not while it swings, when its foot may trail.
double hold_of(double swing) {
  const double off = std::clamp(std::min(swing, 1.0 - swing) / 0.2, 0.0, 1.0);
  return 1.0 - minimum_jerk(off);
}

// Over the feet, upright or along their slope, and as low as the leg with the longest way needs.
Rigid Gait::root_over(std::span<const Vec3> feet, std::span<const double> holds, const GaitFrame& frame,
                      const Vec3& travel_m, double lower_m, double bend) const {
  const Rigid& rest = character_->rest_root();
  double mean_y = 0.0, mean_z = 0.0, zz = 0.0, zy = 0.0;
  const double count = std::max<double>(1.0, static_cast<double>(legs_.size()));
  for (std::size_t i = 0; i < legs_.size(); ++i) mean_y += feet[i].y / count, mean_z += legs_[i].home_m.z / count;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const double z = legs_[i].home_m.z - mean_z;
    zz += z * z, zy += z * (feet[i].y - mean_y);
  }
  const double pitch_rad = rows_ > 1 ? -det::atan2(zy, zz) : 0.0;
  const Quat tilt = axis_angle(Vec3(1, 0, 0), pitch_rad);
  const Vec3 pivot(0.0, 0.0, mean_z);  // on the ground between the feet
  Rigid root{world_from_start_.q * tilt * rest.q,
             world_from_start_ * (pivot + tilt * (rest.p_m - pivot)) + travel_m};
  root.p_m.y = (pivot + tilt * (rest.p_m - pivot)).y + mean_y - lower_m;
  double too_high_m = 0.0;
  const Rigid world_from_character = root * inverse(rest);
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Vec3 ankle = frame.feet[i].world_from_sole * legs_[i].sole_from_ankle;
    const Vec3 hip = world_from_character * legs_[i].hip_m;
    const double reach_m = (1.0 - bend * kBend) * legs_[i].length_m;
    const double across2 = (hip.x - ankle.x) * (hip.x - ankle.x) + (hip.z - ankle.z) * (hip.z - ankle.z);
    const double up_m = std::sqrt(std::max(reach_m * reach_m - across2, 0.04 * reach_m * reach_m));
    too_high_m = std::max(too_high_m, holds[i] * (hip.y - ankle.y - up_m));
  }
  root.p_m.y -= too_high_m;
  return root;
}

GaitFrame Gait::stand(double lower_share) {
  GaitFrame frame;
  std::array<Vec3, kMaxLegs> feet;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    constexpr int kHome = -1;  // no step of a course that begins at 0
    if (steps_[i].number != kHome) {
      steps_[i].from = first_soles_[i];
      steps_[i].number = kHome;
    }
    frame.feet[i].world_from_sole = steps_[i].from;
    feet[i] = steps_[i].from.p_m;
  }
  std::array<double, kMaxLegs> holds;
  holds.fill(1.0);
  frame.root = root_over(std::span(feet).first(legs_.size()), holds, frame, Vec3(0.0), 0.0, 0.0);
  frame.stands_at = world_from_start_;
  frame.root.p_m.y -= lower_share * leg_length_m_;  // from where the legs reach, wherever that is: without a kink
  return frame;
}

// Of the way that half a cycle takes at full speed.
double Gait::step_share(const GaitParams& params, const Pace& pace, double time_s) {
  const double quarter_s = 0.25 * params.cycle_s;
  const double way_m = travelled_m(pace, time_s + quarter_s) - travelled_m(pace, time_s - quarter_s);
  return way_m / std::max(2.0 * quarter_s * params.speed_m_s, 1e-6);
}

GaitFrame Gait::at(const GaitParams& params, double time_s, double duration_s) {
  GaitFrame frame;
  std::array<Vec3, kMaxLegs> feet;  // on their straight ways, without the lift
  std::array<double, kMaxLegs> holds{};
  const Pace pace = pace_of(params, duration_s);
  const double in = minimum_jerk(std::clamp(time_s / (0.5 * params.cycle_s), 0.0, 1.0));
  const double out = minimum_jerk(std::clamp((duration_s - time_s) / (0.5 * params.cycle_s), 0.0, 1.0));
  GaitParams rolling = params;  // from flat feet to flat feet
  rolling.heel_up_rad *= in * out, rolling.toes_up_rad *= in * out;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Cycle cycle = cycle_of(params, legs_[i], time_s);
    take_step(params, pace, legs_[i], cycle.step, steps_[i]);
    const Step& step = steps_[i];
    holds[i] = params.trot ? hold_of(cycle.swing) : 1.0;
    const double share = swing_share(cycle.swing, step.margin);
    feet[i] = step.from.p_m + share * (step.to.p_m - step.from.p_m);
    frame.feet[i].world_from_sole = {slerp_short(step.from.q, step.to.q, share), feet[i]};
    frame.feet[i].world_from_sole.p_m.y += step.bump_m * swing_bump(cycle.swing);
    frame.feet[i].world_from_sole = frame.feet[i].world_from_sole * sole_roll(rolling, legs_[i], step, cycle);
    if (environment_->is_level())  // elsewhere the swing is fitted to the ground with level toes
      frame.feet[i].world_from_sole.q = frame.feet[i].world_from_sole.q *
                                        axis_angle(Vec3(1, 0, 0), toes_down_rad(legs_[i], step.bump_m, cycle.swing));
    frame.feet[i].stands = cycle.swing == 0.0 || step.bump_m == 0.0;
  }
  const double bounce_m = params.bounce_m * root_beat(params, time_s / params.cycle_s) * step_share(params, pace, time_s);
  const double lower_m = in * out * (params.lower_m - bounce_m);
  const Vec3 way = travel(params, travelled_m(pace, time_s));
  frame.stands_at = {world_from_start_.q, world_from_start_.p_m + way};
  frame.root = root_over(std::span(feet).first(legs_.size()), holds, frame, way, lower_m, in * out);
  return frame;
}

}  // namespace contort
