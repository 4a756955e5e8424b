// hit_reaction: the part gives way to a blow and comes back. Every joint of it bends a share about the axis across the
// blow and the vertical, as far as its own axes allow.
#include "generator/actions/action.h"
#include "generator/actions/pulse.h"
#include "generator/motion/turn.h"
#include "model/core/detmath.h"

namespace contort {

std::vector<ParamDef> hit_reaction_params(const Character&, const Part&) {
  ParamDef azimuth;
  azimuth.name = "azimuth_deg";
  azimuth.low = -180.0, azimuth.high = 180.0;
  azimuth.mirrored = Mirrored::opposite;
  azimuth.help = "Direction from which the blow comes: 0 is from the front, 90 from the character's left.";
  ParamDef strength;
  strength.name = "strength_deg";
  strength.low = 0.0, strength.high = 60.0;
  strength.preset = 15.0;
  strength.help = "Greatest angle by which the whole part bends.";
  return {azimuth, strength};
}

bool hit_reaction_supports(const Character&, const Part& part) { return part.joint_count > 0; }

void hit_reaction_rule(const RuleInput& in, Posture& posture) {
  const det::SinCos azimuth = det::sincos(in.params[0] * kRadPerDeg);
  const Vec3 away_world = in.world[0].q * Vec3(-azimuth.sin, 0.0, -azimuth.cos);
  const Vec3 axis_world = glm::cross(Vec3(0.0, 1.0, 0.0), away_world);
  const double angle_rad = in.params[1] * kRadPerDeg * pulse(in.time.progress) / in.part.joint_count;
  for (int j = in.part.first_joint; j < in.part.first_joint + in.part.joint_count; ++j) {
    const auto at = static_cast<std::size_t>(j);
    turn_joint(in.character.joints()[at], in.world[at].q, axis_world, angle_rad, posture);
  }
  in.feedback.impact = true;
}

}  // namespace contort
