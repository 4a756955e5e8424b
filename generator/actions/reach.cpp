// reach: the part's tip goes to a point, given in the character's frame (on the ground under the root, +Z forward).
#include <cmath>

#include "generator/actions/hand.h"
#include "generator/actions/limb_reach.h"
#include "generator/actions/limb_way.h"

namespace contort {

std::vector<ParamDef> reach_params(const Character&, const Part&) {
  ParamDef target;
  target.name = "target_m";
  target.type = ParamType::vector;
  target.low = -10.0, target.high = 10.0;
  target.preset = Vec3(0.0, 1.0, 0.5);
  target.domain = Domain::within_reach;
  target.mirrored = Mirrored::point;
  target.help = "Target of the tip, m, from the ground under the character.";
  ParamDef swivel;
  swivel.name = "swivel_deg";
  swivel.low = -180.0, swivel.high = 180.0;
  swivel.optional = true;
  swivel.mirrored = Mirrored::opposite;
  swivel.help = "Turns elbow or knee about the line to the target, as far as joints and bodies allow; left out: the way that suits the figure best.";
  return {target, swivel};
}

bool reach_supports(const Character&, const Part& part) { return !part.reach.empty(); }

void reach_rule(const RuleInput& in, Posture& posture) {
  // The character's frame is the root's, taken down to the ground that it stands on at rest.
  const Rigid world_from_character = in.world[0] * inverse(in.character.rest_root());
  const Vec3 target = world_from_character * Vec3(in.params[0], in.params[1], in.params[2]);
  const std::optional<double> swivel_rad =
      std::isnan(in.params[3]) ? std::nullopt : std::optional(in.params[3] * kRadPerDeg);
  in.feedback.shortfall = reach_with_travels(in, in.part.reach.front(), target, swivel_rad, posture);
  if (is_arm(in.character, in.part)) go_round(in, posture);
}

}  // namespace contort
