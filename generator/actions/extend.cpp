// extend: the part's travels go to a share of their range; joints that turn stay.
#include "generator/actions/action.h"

namespace contort {

std::vector<ParamDef> extend_params(const Character&, const Part&) {
  ParamDef share;
  share.name = "share";
  share.low = 0.0, share.high = 1.0;
  share.preset = 1.0;
  share.help = "Share of the travel: 0 is drawn in, 1 all the way out.";
  return {share};
}

bool extend_supports(const Character& character, const Part& part) {
  for (int j = part.first_joint; j < part.first_joint + part.joint_count; ++j)
    if (character.joints()[static_cast<std::size_t>(j)].kind == JointKind::prismatic) return true;
  return false;
}

void extend_rule(const RuleInput& in, Posture& posture) {
  for (int j = in.part.first_joint; j < in.part.first_joint + in.part.joint_count; ++j) {
    const Joint& joint = in.character.joints()[static_cast<std::size_t>(j)];
    if (joint.kind == JointKind::prismatic)
      posture.coords[static_cast<std::size_t>(joint.coord)] = joint.low + in.params[0] * (joint.high - joint.low);
  }
}

}  // namespace contort
