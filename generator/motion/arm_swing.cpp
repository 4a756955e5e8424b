#include "generator/motion/arm_swing.h"

#include <algorithm>

#include "generator/motion/joint_clamp.h"
#include "generator/motion/turn.h"
#include "model/core/index.h"

namespace contort {

namespace {

bool carries_object(const Character& character, int part) {
  return std::ranges::any_of(character.sockets(), [&](const Socket& socket) {
    int p = character.joint(socket.joint).part;
    while (p > part) p = carrier_of(character, p);
    return p == part && socket.name.starts_with("object:");
  });
}

}  // namespace

bool is_free_arm(const Character& character, std::span<const Leg> legs, int part) {
  const Part& own = character.parts()[at(part)];
  const bool stands = std::ranges::any_of(legs, [&](const Leg& leg) { return leg.part == part; });
  return !own.reach.empty() && own.side != Side::center && !stands && !carries_object(character, part);
}

void swing_arm(const Character& character, int part, const ArmSwing& swing, std::span<const Rigid> world,
               Posture& posture) {
  const Part& own = character.parts()[at(part)];
  const ReachChain& chain = own.reach.front();
  const double outward = own.side == Side::left ? 1.0 : -1.0;
  const Joint& shoulder = character.joint(chain.upper);
  const Quat &from_joint = world[at(chain.upper)].q, &from_root = world[0].q;
  turn_joint(shoulder, from_joint, from_root * Vec3(-1.0, 0.0, 0.0), swing.forward_rad, posture);
  turn_joint(shoulder, from_joint, from_root * Vec3(0.0, 0.0, outward), swing.out_rad, posture);
  const Joint& elbow = character.joint(chain.middle);
  if (elbow.kind == JointKind::hinge)
    posture.coords[at(elbow.coord)] += elbow.high > -elbow.low ? swing.elbow_rad : -swing.elbow_rad;
  clamp_part(character, at(part), posture);
}

}  // namespace contort
