// Signed distances between solids. A solid is a core (point, segment, box or convex hull) with a radius around it; the
// signed distance of two solids is that of their cores less both radii. Cores apart: the Euclidean distance. Cores that
// overlap: minus the depth, the shortest translation that parts them. Double precision. The formulas are closed, except
// for hulls that are apart (hull_distance.h): a bounded iteration either proves its result, or a closed formula is used
// instead.
#pragma once

#include <memory>

#include "model/character/character.h"

namespace contort {

struct Solid {
  enum class Core { point, segment, box, hull };
  Core core = Core::point;
  Vec3 center_m{0.0};
  Vec3 axis{1, 0, 0};                        // segment: its unit direction
  double half_length_m = 0.0;                // segment: from the centre to one end
  double radius_m = 0.0;                     // >= 0
  double bound_m = 0.0;                      // radius of a ball about the centre that contains the solid
  Mat3 axes{1.0};                            // box, hull: columns are its unit axes
  Vec3 half_m{0.0};                          // box: half of each side
  std::shared_ptr<const Polyhedron> hull{};  // hull: its corners are center_m + axes * corner

  bool is_round() const { return core == Core::point || core == Core::segment; }  // a sphere or a capsule
};

Solid solid_of(const ColliderShape& shape);
Solid solid_of(const Collider& collider);  // in the frame of its joint
Solid moved(const Rigid& to_from_own, const Solid& solid);
// Moves `placed`, which is a moved copy of `solid`; writes only the fields that change.
void place(const Rigid& to_from_own, const Solid& solid, Solid& placed);

// The extent of a solid from its centre along the unit vector n, in metres.
double extent_along(const Solid& solid, const Vec3& n);

// Returns the gap from a to b along the unit vector n. It is never greater than their signed distance.
double gap_along(const Solid& a, const Solid& b, const Vec3& n);

// Returns approximately the direction in which b gets away from a fastest: the direction between their nearest points,
// or, if they overlap, of the shortest translation that separates them. It is used for bounds, which hold for any
// direction.
Vec3 way_out(const Solid& a, const Solid& b);

// Returns the signed distance in metres. If it is greater than `band_m`, the result may be any number in (band_m,
// true distance]. NaN coordinates give NaN.
double signed_distance(const Solid& a, const Solid& b, double band_m);

// Also returns the way_out if it is known without further computation, and otherwise 0: for hulls, for NaN coordinates,
// and for round solids whose cores cross. Beyond the band it is any direction along which the solids are that far
// apart.
double signed_distance(const Solid& a, const Solid& b, double band_m, Vec3& way);

}  // namespace contort
