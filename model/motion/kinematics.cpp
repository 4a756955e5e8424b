#include "model/motion/kinematics.h"

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

namespace {

// By the joint's own motion, from where it rests.
void move(const Joint& joint, const double* q, Rigid& world_from_joint) {
  auto& [turn, place_m] = world_from_joint;
  switch (joint.kind) {
    case JointKind::hinge: turn = turn * axis_angle(joint.axis, q[0]); break;
    case JointKind::ball: turn = turn * Quat(q[0], q[1], q[2], q[3]); break;
    case JointKind::prismatic: place_m += turn * (q[0] * joint.axis); break;
    case JointKind::root: break;
  }
}

}  // namespace

void forward_kinematics(const Character& character, std::span<const double> row, int first, int last,
                        std::span<Rigid> world) {
  const std::span<const Joint> joints = character.joints();
  for (int i = first; i < last; ++i) {
    const Joint& joint = joints[static_cast<std::size_t>(i)];
    if (joint.kind == JointKind::root) continue;
    Rigid& own = world[static_cast<std::size_t>(i)];
    own = world[static_cast<std::size_t>(joint.parent)] * joint.parent_from_joint;
    move(joint, row.data() + joint.coord, own);
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
