#include "generator/motion/kinematics.h"

namespace contort {

Rigid joint_motion(const Joint& joint, std::span<const double> row) {
  const double* q = row.data() + joint.coord;
  switch (joint.kind) {
    case JointKind::hinge: return {axis_angle(joint.axis, q[0]), Vec3(0.0)};
    case JointKind::ball: return {Quat(q[0], q[1], q[2], q[3]), Vec3(0.0)};
    case JointKind::prismatic: return {kNoRotation, q[0] * joint.axis};
    case JointKind::root: break;
  }
  return {};
}

void forward_kinematics(const Character& character, std::span<const double> row, int first, int last,
                        std::span<Rigid> world) {
  const std::span<const Joint> joints = character.joints();
  for (int i = first; i < last; ++i) {
    const Joint& joint = joints[static_cast<std::size_t>(i)];
    if (joint.kind == JointKind::root) continue;
    world[static_cast<std::size_t>(i)] =
        world[static_cast<std::size_t>(joint.parent)] * joint.parent_from_joint * joint_motion(joint, row);
  }
}

void forward_kinematics(const Character& character, const Rigid& root, std::span<const double> row,
                        std::span<Rigid> world) {
  world[0] = root;
  forward_kinematics(character, row, 1, static_cast<int>(character.joints().size()), world);
}

Rigid world_from_socket(const Character& character, std::span<const Rigid> world, int socket) {
  const Socket& s = character.sockets()[static_cast<std::size_t>(socket)];
  return world[static_cast<std::size_t>(s.joint)] * s.joint_from_socket;
}

}  // namespace contort
