// angular_velocity: the speed between two neighbouring frames, against the joint's own limit. A ball joint's angle is
// the one of the rotation between the two, the short way, so that the sign of a quaternion does not matter.
#include <cmath>

#include "checks/check.h"

namespace contort {

namespace {

double step_of(const Joint& joint, const double* before, const double* now) {
  if (joint.kind != JointKind::ball) return std::fabs(now[joint.coord] - before[joint.coord]);
  const double* a = before + joint.coord;
  const double* b = now + joint.coord;
  return rotation_angle(glm::conjugate(Quat(a[0], a[1], a[2], a[3])) * Quat(b[0], b[1], b[2], b[3]));
}

}  // namespace

int angular_velocity_subject_count(const Character& character) {
  return static_cast<int>(character.joints().size()) - 1;  // without the root
}

Subject angular_velocity_subject(const Character& character, int subject) {
  const Joint& joint = character.joints()[static_cast<std::size_t>(subject) + 1];
  return {joint.name, joint.kind == JointKind::prismatic ? "m/s" : "rad/s"};
}

void angular_velocity_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Joint> joints = in.character.joints();
  for (int frame = 1; frame < in.motion.frame_count; ++frame) {
    const double* before = in.motion.row(frame - 1).data();
    const double* now = in.motion.row(frame).data();
    for (std::size_t j = 1; j < joints.size(); ++j) {
      const double speed = step_of(joints[j], before, now) * in.motion.rate_hz;
      fold.report(static_cast<int>(j) - 1, frame, joints[j].max_speed - speed);
    }
  }
}

}  // namespace contort
