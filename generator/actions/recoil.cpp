// recoil: the arm jerks up and its elbow gives, and both settle. Short on purpose: use it over aim or weapon_hold.
#include "generator/actions/hand.h"
#include "generator/actions/pulse.h"
#include "generator/motion/turn.h"

namespace contort {

std::vector<ParamDef> recoil_params(const Character&, const Part&) {
  ParamDef rise;
  rise.name = "rise_deg";
  rise.low = 0.0, rise.high = 45.0;
  rise.preset = 5.0;
  rise.help = "Angle by which the arm is thrown up.";
  ParamDef bend;
  bend.name = "bend_deg";
  bend.low = 0.0, bend.high = 60.0;
  bend.preset = 8.0;
  bend.help = "Angle by which the elbow bends.";
  return {rise, bend};
}

bool recoil_supports(const Character& character, const Part& part) { return is_arm(character, part); }

void recoil_rule(const RuleInput& in, Posture& posture) {
  const ReachChain& chain = in.part.reach.front();
  const std::span<const Joint> joints = in.character.joints();
  const double share = pulse(in.time.progress) * kRadPerDeg;
  // About the axis to the character's right, which lifts what points forward.
  const Vec3 right_world = in.world[0].q * Vec3(-1.0, 0.0, 0.0);
  for (int j = chain.upper; j <= chain.upper_last; ++j) {
    const auto at = static_cast<std::size_t>(j);
    turn_joint(joints[at], in.world[at].q, right_world, in.params[0] * share, posture);
  }
  const Joint& middle = joints[static_cast<std::size_t>(chain.middle)];
  const double flexion = middle.high >= -middle.low ? 1.0 : -1.0;  // the way in which it has more room
  posture.coords[static_cast<std::size_t>(middle.coord)] += flexion * in.params[1] * share;
}

}  // namespace contort
