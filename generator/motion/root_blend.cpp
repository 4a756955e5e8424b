#include "generator/motion/root_blend.h"

#include <algorithm>

#include "model/core/detmath.h"

namespace contort {

namespace {

double shortest_leg_m(std::span<const Leg> legs) {
  double least = legs.front().length_m;
  for (const Leg& leg : legs) least = std::min(least, leg.length_m);
  return least;
}

double height_at(const LegsBelow& below, const Vec3& at) { return below.environment.height_at(at.x, at.z); }

// Half of the knees' angle at a height that is `lower_m` below straight legs; above, where none bends, minus the way.
double bend_of(double lower_m, double leg_m) {
  return lower_m <= 0.0 ? lower_m / leg_m : det::acos(std::max(0.0, 1.0 - lower_m / leg_m));
}
double lower_of(double bend, double leg_m) { return bend <= 0.0 ? bend * leg_m : leg_m * (1.0 - det::cos(bend)); }

}  // namespace

Rigid blend_root(const LegsBelow& below, const Rigid& a, const Rigid& b, double weight) {
  if (weight <= 0.0) return a;
  if (weight >= 1.0) return b;
  Rigid blended{slerp_short(a.q, b.q, weight), a.p_m + (b.p_m - a.p_m) * weight};
  if (below.legs.empty()) return blended;
  const double leg_m = shortest_leg_m(below.legs);
  const double straight_m = below.character.rest_root().p_m.y;
  const auto bend_at = [&](const Rigid& root) {
    return bend_of(straight_m + height_at(below, root.p_m) - root.p_m.y, leg_m);
  };
  const double from = bend_at(a), to = bend_at(b);
  blended.p_m.y = straight_m + height_at(below, blended.p_m) - lower_of(from + weight * (to - from), leg_m);
  return blended;
}

Rigid brought_along(const LegsBelow& below, const Rigid& root, const Rigid& from, const Rigid& to) {
  Rigid brought = to * inverse(from) * root;
  brought.p_m.y += height_at(below, to.p_m) - height_at(below, from.p_m);
  return brought;
}

}  // namespace contort
