// look_at: the part keeps facing a point while the character moves.
#include "generator/actions/action.h"
#include "generator/motion/ik.h"
#include "model/motion/kinematics.h"

namespace contort {

std::vector<ParamDef> look_at_params(const Character&, const Part&) {
  ParamDef target;
  target.name = "target_m";
  target.type = ParamType::vector;
  target.low = -1000.0, target.high = 1000.0;
  target.preset = Vec3(0.0, 1.5, 3.0);
  target.domain = Domain::around;
  target.mirrored = Mirrored::point;
  target.help = "Target point, m, from the place where the character stood at first.";
  return {target};
}

bool look_at_supports(const Character&, const Part& part) { return !part.facing.empty(); }

void look_at_rule(const RuleInput& in, Posture& posture) {
  constexpr int kPasses = 3;  // the eyes move when the head turns: after three passes by less than 1e-4 rad at 1 m
  const FacingChain& chain = in.part.facing.front();
  const Vec3 target_world = in.world_from_start * Vec3(in.params[0], in.params[1], in.params[2]);
  for (int pass = 0; pass < kPasses; ++pass) {
    const Rigid world_from_eyes = world_from_socket(in.character, in.world, chain.socket);
    const Vec3 direction = unit_or(target_world - world_from_eyes.p_m, world_from_eyes.q * Vec3(0.0, 0.0, 1.0));
    face_direction(in.character, chain, in.world, direction, posture.coords);
    forward_kinematics(in.character, posture.coords, in.part.first_joint, in.part.first_joint + in.part.joint_count,
                       in.world);
  }
}

}  // namespace contort
