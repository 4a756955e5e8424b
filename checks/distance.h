// Signed distances between solids. A solid is a core (point, segment or box) with a radius around it; the signed
// distance of two solids is that of their cores less both radii. Cores apart: the Euclidean distance. Cores that
// overlap: minus the depth, the shortest translation that parts them. Double precision, closed form, no iteration.
#pragma once

#include "generator/character/shape.h"

namespace contort {

struct Solid {
  enum class Core { point, segment, box };
  Core core = Core::point;
  Vec3 center_m{0.0};
  Vec3 half_segment_m{0.0};  // segment: from the centre to one end
  Mat3 axes{1.0};            // box: columns are its unit axes
  Vec3 half_m{0.0};          // box: half of each side
  double radius_m = 0.0;     // >= 0
  double bound_m = 0.0;      // radius of a ball about the centre that holds the solid
};

Solid solid_of(const ColliderShape& shape);
Solid moved(const Rigid& to_from_own, const Solid& solid);

// Signed distance in metres. Where it is greater than `band_m`, any number in (band_m, true distance] may come back
// instead: far apart is far apart. NaN coordinates give NaN.
double signed_distance(const Solid& a, const Solid& b, double band_m);

}  // namespace contort
