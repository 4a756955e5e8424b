// reach: the part's tip goes to a point, given in the character's frame (on the ground under the root, +Z forward).
#include "generator/actions/action.h"
#include "generator/motion/ik.h"

namespace contort {

std::vector<ParamDef> reach_params(const Character&, const Part&) {
  ParamDef target;
  target.name = "target_m";
  target.type = ParamType::vector;
  target.low = -10.0, target.high = 10.0;
  target.preset = Vec3(0.0, 1.0, 0.5);
  target.domain = Domain::within_reach;
  target.mirrored = Mirrored::point;
  target.help = "Where the tip goes, m, from the ground under the character.";
  ParamDef swivel;
  swivel.name = "swivel_deg";
  swivel.low = -180.0, swivel.high = 180.0;
  swivel.preset = 0.0;
  swivel.mirrored = Mirrored::opposite;
  swivel.help = "Turns elbow or knee about the line to the target.";
  return {target, swivel};
}

bool reach_supports(const Character&, const Part& part) { return !part.reach.empty(); }

void reach_rule(const RuleInput& in, Posture& posture) {
  // The character's frame is the root's, taken down to the ground that it stands on at rest.
  const Rigid world_from_character = in.world[0] * inverse(in.character.rest_root());
  const Vec3 target(in.params[0], in.params[1], in.params[2]);
  reach_for(in.character, in.part.reach.front(), in.world, world_from_character * target, in.params[3] * kRadPerDeg,
            posture.coords);
}

}  // namespace contort
