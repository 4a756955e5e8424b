#include "generator/motion/swing.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/foot_roll.h"
#include "generator/motion/foothold.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kClearance_m = 0.015;  // of a swinging foot

// From 0 to 1 at an even speed between two ramps, along which the speed goes as 3u^2 - 2u^3: a swing nearly as gentle
// as that of people, whose ankles go at most 3.1 to 3.4 times as fast as they walk. A minimum-jerk one has 4.9 times.
double even_way(double u, double rise, double fall) {
  const auto ramped = [](double time, double ramp) {
    const double v = std::min(time / ramp, 1.0);
    return ramp * (v * v * v - 0.5 * v * v * v * v);
  };
  const double whole = 1.0 - 0.5 * rise - 0.5 * fall;
  if (u > 1.0 - fall) return 1.0 - ramped(1.0 - u, fall) / whole;
  return (ramped(u, rise) + std::max(0.0, u - rise)) / whole;
}

// Swing, horizontally: between two margins of its time, so that the foot leaves and meets the ground vertically.
double swing_share(const Step& step, double swing) {
  return even_way(std::clamp((swing - step.margin) / (1.0 - 2.0 * step.margin), 0.0, 1.0), step.rise, step.fall);
}
double swing_bump(const Step& step, double swing) {
  const double left = swing * (1.0 - swing);
  return 16.0 * left * left * (1.0 + step.late * (swing - 0.5));
}

double across_m(const Vec3& from, const Vec3& to) {
  return std::sqrt((to.x - from.x) * (to.x - from.x) + (to.z - from.z) * (to.z - from.z));
}

// The longest way of the sole's origin and of the corners of its footprint: a foot that turns goes somewhere, too.
double longest_way_m(const Leg& leg, const Rigid& from, const Rigid& to) {
  double longest_m = across_m(from.p_m, to.p_m);
  if (from.q == to.q) return longest_m;
  for (const double x : {leg.low_m.x, leg.high_m.x})
    for (const double z : {leg.low_m.z, leg.high_m.z})
      longest_m = std::max(longest_m, across_m(from * Vec3(x, 0.0, z), to * Vec3(x, 0.0, z)));
  return longest_m;
}

// Toes hang while a foot comes up behind, as far as they have half of its lift above the ground: a foot that stays
// level asks more of its ankle the more the knee bends.
double toes_down_rad(const Leg& leg, const Step& step, double swing) {
  const double toes_m = std::max(leg.high_m.z, 0.01);
  return std::min(0.5 * step.bump_m / toes_m, kSteepestSole_rad) * swing_bump(step, swing) * 2.0 * (1.0 - swing);
}

// The height to which a swing lifted by bump_m must be raised for toes, heel and middle of a sole on its straight way
// to clear the ground.
double raised_bump(const Environment& environment, const Leg& leg, const Rigid& sole, double bump, double bump_m) {
  for (int i = 0; i < kAcross; i += 2)
    for (int j = 0; j < kLong; j += 3) {
      const Vec3 at = sole * footprint_point(leg, i, j);
      const double missing_m = environment.height_at(at.x, at.z) - at.y;
      if (missing_m > -kClearance_m * bump) bump_m = std::max(bump_m, missing_m / bump + kClearance_m);
    }
  return bump_m;
}

// Lower on a short way, but a step of a centimetre scrapes if it is not lifted by as much.
double least_bump(double lift_m, double horizontal_m) {
  return std::max(lift_m * std::min(1.0, horizontal_m / 0.15), std::min(kClearance_m, horizontal_m));
}

// The height by which a swing with this margin must be lifted over its straight way.
double clear_bump(const Environment& environment, const Leg& leg, const Step& step) {
  constexpr int kSamples = 96;  // a centimetre of way each: no edge is stepped over unseen
  const Vec3 way = step.to.p_m - step.from.p_m;
  double bump_m = 0.0;
  for (int n = 1; n < kSamples; ++n) {
    const double swing = static_cast<double>(n) / kSamples;
    const double share = swing_share(step, swing);
    if (share <= 0.0 || share >= 1.0) continue;
    const Rigid sole{slerp_short(step.from.q, step.to.q, share), step.from.p_m + share * way};
    bump_m = raised_bump(environment, leg, sole, swing_bump(step, swing), bump_m);
  }
  return bump_m;
}

// 0 where what is above a sole's end would turn into a riser.
double room_to_roll(const Environment& environment, const Leg& leg, const Rigid& world_from_sole, double end_m,
                    double beyond_m) {
  if (environment.is_level()) return 1.0;
  for (const double x : {leg.low_m.x, 0.0, leg.high_m.x}) {
    const Vec3 at = world_from_sole * Vec3(x, 0.0, end_m + beyond_m);
    if (environment.height_at(at.x, at.z) > at.y + kClearance_m) return 0.0;
  }
  return 1.0;
}

// The part of toes_up_rad that is left if the ground under a sole raises its toes already.
double left_of_toes_up(const Rigid& world_from_sole, double toes_up_rad) {
  if (toes_up_rad <= 0.0) return 1.0;
  const double uphill_rad = det::asin(std::clamp((world_from_sole.q * Vec3(0, 0, 1)).y, -1.0, 1.0));
  return std::clamp(1.0 - uphill_rad / toes_up_rad, 0.0, 1.0);
}

}  // namespace

void choose_swing(const Environment& environment, const Leg& leg, double lift_m, Step& step) {
  constexpr double kMargins[] = {0.05, 0.1, 0.15, 0.2, 0.25, 0.3};
  const double horizontal_m = longest_way_m(leg, step.from, step.to);
  const double least_m = least_bump(lift_m, horizontal_m);
  step.margin = kMargins[0], step.bump_m = least_m;
  if (environment.is_level() || horizontal_m < 1e-6) return;
  const double enough_m = 2.0 * lift_m + 0.5 * std::fabs(step.to.p_m.y - step.from.p_m.y);
  Step best = step;
  best.bump_m = 1e9;
  for (const double margin : kMargins) {
    step.margin = margin;
    step.bump_m = std::max(least_m, clear_bump(environment, leg, step));
    if (step.bump_m < best.bump_m) best = step;
    if (best.bump_m <= enough_m) break;
  }
  step = best;
  step.bump_m = std::min(step.bump_m, 0.5 * leg.length_m);  // higher no leg gets
}

void choose_rolling(const Environment& environment, const Leg& leg, double stride_m, double toes_up_rad,
                    const Rigid& before, Step& step) {
  const double beyond_m = 0.7 * leg.sole_from_ankle.y;
  const double came = std::min(1.0, across_m(before.p_m, step.from.p_m) / stride_m);
  const double goes = std::min(1.0, across_m(step.from.p_m, step.to.p_m) / stride_m);
  step.landed_up = came * left_of_toes_up(step.from, toes_up_rad) *
                   room_to_roll(environment, leg, step.from, leg.low_m.z, -beyond_m);
  step.leaves_up = goes * room_to_roll(environment, leg, step.from, leg.high_m.z, beyond_m);
  step.lands_up = goes * left_of_toes_up(step.to, toes_up_rad) *
                  room_to_roll(environment, leg, step.to, leg.low_m.z, -beyond_m);
}

Vec3 straight_way(const Step& step, double swing) {
  return step.from.p_m + swing_share(step, swing) * (step.to.p_m - step.from.p_m);
}

Rigid swung_sole(const Environment& environment, const Leg& leg, const Step& step, const FootCycle& cycle,
                 const GaitParams& params, double moving) {
  const double toes_up = cycle.swing > 0.0 ? step.lands_up : step.landed_up;
  Rigid sole{slerp_short(step.from.q, step.to.q, swing_share(step, cycle.swing)),
             straight_way(step, cycle.swing)};
  sole.p_m.y += step.bump_m * swing_bump(step, cycle.swing);
  const double heel_share = step.leaves_up * heel_rise(params.roll, params.duty, cycle.stance, cycle.swing);
  const double toe_share = toes_up * toe_rise(params.roll, cycle.stance, cycle.swing);
  sole = sole * rolled_sole(leg, moving * heel_share * params.heel_up_rad, moving * toe_share * params.toes_up_rad);
  if (environment.is_level())  // elsewhere the swing is fitted to the ground with level toes
    sole.q = sole.q * axis_angle(Vec3(1, 0, 0), toes_down_rad(leg, step, cycle.swing));
  return sole;
}

}  // namespace contort
