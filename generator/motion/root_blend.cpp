#include "generator/motion/root_blend.h"

#include <algorithm>

#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kLeftBent = 0.005;  // of the shortest leg: an easily bent knee lets a foot that is late still land
constexpr double kReaches_m = 1e-6;  // hips that are no higher than legs reach stay as they are

double shortest_leg_m(std::span<const Leg> legs) {
  double least = legs.front().length_m;
  for (const Leg& leg : legs) least = std::min(least, leg.length_m);
  return least;
}

double most_bent_m(std::span<const Leg> legs) {
  double most = 0.0;
  for (const Leg& leg : legs) most = std::max(most, leg.kept_bent_m);
  return most;
}

double height_at(const LegsBelow& below, const Vec3& at) { return below.environment.height_at(at.x, at.z); }

// The height of a root over legs that are straight where it is by `short_m` below its height at rest.
double straight_at_m(const LegsBelow& below, const Vec3& at, double short_m) {
  return below.character.rest_root().p_m.y - short_m + height_at(below, at);
}

// As low as legs apart need it, but no lower than either root: hips above that stand on legs that are not apart.
double short_of_both_m(const LegsBelow& below, const Rigid& a, const Rigid& b) {
  const auto below_rest_m = [&](const Rigid& root) { return straight_at_m(below, root.p_m, 0.0) - root.p_m.y; };
  return std::clamp(std::min(below_rest_m(a), below_rest_m(b)), 0.0, below.short_m);
}

// Half of the knees' angle at a height that is `lower_m` below straight legs; above, where none bends, minus the way.
double bend_of(double lower_m, double leg_m) {
  return lower_m <= 0.0 ? lower_m / leg_m : det::acos(std::max(0.0, 1.0 - lower_m / leg_m));
}
double lower_of(double bend, double leg_m) { return bend <= 0.0 ? bend * leg_m : leg_m * (1.0 - det::cos(bend)); }

}  // namespace

Rigid blend_root(const LegsBelow& below, const Rigid& a, const Rigid& b, double weight) {
  if (weight <= 0.0) return a;
  if (weight >= 1.0) return b;
  Rigid blended = part_way(a, b, weight);
  if (below.legs.empty()) return blended;
  const double leg_m = shortest_leg_m(below.legs);
  const double short_m = short_of_both_m(below, a, b);
  const auto bend_at = [&](const Rigid& root) {
    return bend_of(straight_at_m(below, root.p_m, short_m) - root.p_m.y, leg_m);
  };
  const double from = bend_at(a), to = bend_at(b);
  blended.p_m.y = straight_at_m(below, blended.p_m, short_m) - lower_of(from + weight * (to - from), leg_m);
  return blended;
}

double lower_to_reach_m(const LegsBelow& below, Rigid& root) {
  if (!(below.short_m > 0.0) || root.p_m.y <= straight_at_m(below, root.p_m, below.short_m) + kReaches_m) return 0.0;
  const double bent_m = kLeftBent * shortest_leg_m(below.legs) - most_bent_m(below.legs);
  const double short_m = below.short_m + std::clamp(bent_m, 0.0, below.short_m);
  const double lower_m = std::max(0.0, root.p_m.y - straight_at_m(below, root.p_m, short_m));
  root.p_m.y -= lower_m;
  return lower_m;
}

Rigid brought_along(const LegsBelow& below, const Rigid& root, const Rigid& from, const Rigid& to) {
  Rigid brought = to * inverse(from) * root;
  brought.p_m.y += height_at(below, to.p_m) - height_at(below, from.p_m);
  return brought;
}

}  // namespace contort
