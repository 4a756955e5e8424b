#include "generator/motion/turn.h"

namespace contort {

void turn_joint(const Joint& joint, const Quat& world_from_joint, const Vec3& axis_world, double angle_rad,
                Posture& posture) {
  const Vec3 axis = glm::conjugate(world_from_joint) * axis_world;
  double* q = posture.coords.data() + joint.coord;
  if (joint.kind == JointKind::hinge) q[0] += angle_rad * glm::dot(axis, joint.axis);
  if (joint.kind != JointKind::ball) return;
  const Quat turned = glm::normalize(Quat(q[0], q[1], q[2], q[3]) * axis_angle(axis, angle_rad));
  q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
}

}  // namespace contort
