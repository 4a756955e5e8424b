// direction: the part faces a direction, given as azimuth and elevation in the character's frame.
#include "generator/actions/action.h"
#include "generator/motion/ik.h"
#include "model/core/detmath.h"

namespace contort {

std::vector<ParamDef> direction_params(const Character&, const Part&) {
  ParamDef azimuth;
  azimuth.name = "azimuth_deg";
  azimuth.low = -180.0, azimuth.high = 180.0;
  azimuth.mirrored = Mirrored::opposite;
  azimuth.help = "Azimuth of the direction: 0 is forward, 90 to the character's left.";
  ParamDef elevation;
  elevation.name = "elevation_deg";
  elevation.low = -90.0, elevation.high = 90.0;
  elevation.help = "Elevation of the direction: 0 is level, 90 straight up.";
  return {azimuth, elevation};
}

bool direction_supports(const Character&, const Part& part) { return !part.facing.empty(); }

void direction_rule(const RuleInput& in, Posture& posture) {
  const det::SinCos azimuth = det::sincos(in.params[0] * kRadPerDeg);
  const det::SinCos elevation = det::sincos(in.params[1] * kRadPerDeg);
  const Vec3 direction(elevation.cos * azimuth.sin, elevation.sin, elevation.cos * azimuth.cos);
  face_direction(in.character, in.part.facing.front(), in.world, in.world[0].q * direction, posture.coords);
}

}  // namespace contort
