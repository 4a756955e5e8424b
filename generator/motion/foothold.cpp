#include "generator/motion/foothold.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/foot_roll.h"
#include "model/core/detmath.h"

namespace contort {

Vec3 footprint_point(const Leg& leg, int across, int lengthwise) {
  const double u = static_cast<double>(across) / (kAcross - 1);
  const double w = static_cast<double>(lengthwise) / (kLong - 1);
  return {leg.low_m.x + u * (leg.high_m.x - leg.low_m.x), 0.0, leg.low_m.z + w * (leg.high_m.z - leg.low_m.z)};
}

namespace {

constexpr double kShareOfAnkle = 0.8;  // of its range, so that the leg above may lean a little

// The points under a foot, in its sole's frame, and the heights of the ground there.
struct Footprint {
  Vec3 points[kAcross * kLong];
  double heights_m[kAcross * kLong];
  Vec3 middle{0.0};
  double mean_m = 0.0;
};

Footprint footprint(const Environment& environment, const Leg& leg, const Rigid& world_from_sole) {
  Footprint print;
  for (int k = 0; k < kAcross * kLong; ++k) {
    print.points[k] = footprint_point(leg, k / kLong, k % kLong);
    const Vec3 at = world_from_sole * print.points[k];
    print.heights_m[k] = environment.height_at(at.x, at.z);
    print.mean_m += print.heights_m[k] / (kAcross * kLong);
    print.middle += print.points[k] / static_cast<double>(kAcross * kLong);
  }
  return print;
}

// The plane is laid on the highest points, so that nothing is below the ground.
void lay_on_highest(const Footprint& print, Foothold& foothold) {
  double highest = -1e9, lowest = 1e9;
  for (int k = 0; k < kAcross * kLong; ++k) {
    const Vec3& point = print.points[k];
    const double over = print.heights_m[k] - foothold.slope_x * point.x - foothold.slope_z * point.z;
    highest = std::max(highest, over), lowest = std::min(lowest, over);
  }
  foothold.height_m = highest;
  foothold.unevenness_m = highest - lowest;
}

Rigid put_down(const Quat& turn, const Vec3& at, const Foothold& foothold) {
  // Pitch about the sole's x, then roll about its z, as small rotations of one vector.
  const Vec3 normal = unit_or(Vec3(-foothold.slope_x, 1.0, -foothold.slope_z), Vec3(0, 1, 0));
  return {turn * shortest_arc(Vec3(0, 1, 0), normal), Vec3(at.x, foothold.height_m, at.z)};
}

// Returns true if a foot that would be put down is seen there already: then it is left as it is.
bool stands_there(const Rigid& placed, const Rigid& seen) {
  constexpr double kStands_m = 0.002;
  const Vec3 up_seen = seen.q * Vec3(0, 1, 0), up_placed = placed.q * Vec3(0, 1, 0);
  return std::fabs(placed.p_m.y - seen.p_m.y) < kStands_m && glm::dot(up_seen, up_placed) > 0.999;
}

// Higher than steps lift it: an action of its own has taken it there.
bool is_high(const Environment& environment, const Leg& leg, const Rigid& sole) {
  constexpr double kHigh = 0.08;  // of the leg's length
  const Vec3 lowest_m = sole * lower_end_m(leg, sole);
  return lowest_m.y - environment.height_at(lowest_m.x, lowest_m.z) > kHigh * leg.length_m;
}

}  // namespace

Foothold foothold_at(const Environment& environment, const Leg& leg, const Rigid& world_from_sole) {
  const Footprint print = footprint(environment, leg, world_from_sole);
  double xx = 1e-12, zz = 1e-12, xh = 0.0, zh = 0.0;
  for (int k = 0; k < kAcross * kLong; ++k) {
    const Vec3 point = print.points[k] - print.middle;
    xx += point.x * point.x, zz += point.z * point.z;
    xh += point.x * (print.heights_m[k] - print.mean_m), zh += point.z * (print.heights_m[k] - print.mean_m);
  }
  Foothold foothold;
  const auto slope = [](double angle_rad) { return det::sin(angle_rad) / det::cos(angle_rad); };
  const double steepest_x = slope(std::min(kSteepestSole_rad, kShareOfAnkle * leg.tilts_rad));
  const double steepest_z = slope(kSteepestSole_rad);
  foothold.slope_x = std::clamp(xh / xx, -steepest_x, steepest_x);
  foothold.slope_z = std::clamp(zh / zz, -steepest_z, steepest_z);
  lay_on_highest(print, foothold);
  return foothold;
}

Rigid stand_at(const Environment& environment, const Leg& leg, const Quat& turn, const Vec3& at_m,
               const Vec3& direction) {
  constexpr double kStep_m = 0.02;
  constexpr int kSteps = 12;
  constexpr double kFarther = 0.02;  // unevenness that one metre of detour is worth
  Foothold best;
  Vec3 best_at = at_m;
  double best_cost = 1e9;
  for (int n = 0; n <= 2 * kSteps; ++n) {
    const int steps = n % 2 == 0 ? -n / 2 : (n + 1) / 2;  // 0, 1, -1, 2, -2 …
    const Vec3 at = at_m + steps * kStep_m * direction;
    const Foothold foothold = foothold_at(environment, leg, {turn, at});
    const double cost = foothold.unevenness_m + kFarther * kStep_m * std::abs(steps);
    if (cost < best_cost - 1e-9) best = foothold, best_at = at, best_cost = cost;
    if (environment.is_level()) break;
  }
  return put_down(turn, best_at, best);
}

Rigid first_sole(const Environment& environment, const Leg& leg, const Rigid& world_from_start, const Rigid* seen) {
  constexpr double kFarthest = 0.4;  // from home, of the leg's length: about half of a long stride
  const Vec3 home = home_of(leg, world_from_start);
  const Vec3 off = seen != nullptr ? seen->p_m - home : Vec3(0.0);
  const double off_m = std::sqrt(off.x * off.x + off.z * off.z);
  if (seen == nullptr || off_m > kFarthest * leg.length_m || is_high(environment, leg, *seen))
    return stand_at(environment, leg, world_from_start.q, home, world_from_start.q * Vec3(0, 0, 1));
  const auto placed_about = [&](const Vec3& on) {
    const Vec3 at = *seen * on - world_from_start.q * on;
    return put_down(world_from_start.q, at, foothold_at(environment, leg, {world_from_start.q, at}));
  };
  return stands_there(placed_about(Vec3(0.0)), *seen) ? *seen : placed_about(lower_end_m(leg, *seen));
}

}  // namespace contort
