#include "checks/joint_steps.h"

#include <cmath>

namespace contort {

namespace {

constexpr double kRadPerMetre = 10.0;

Quat ball_step(const double* a, const double* b) {
  return glm::conjugate(Quat(a[0], a[1], a[2], a[3])) * Quat(b[0], b[1], b[2], b[3]);
}

}  // namespace

double joint_step(const Joint& joint, const double* before, const double* now) {
  if (joint.kind != JointKind::ball) return std::fabs(now[joint.coord] - before[joint.coord]);
  return rotation_angle(ball_step(before + joint.coord, now + joint.coord));
}

Vec3 joint_step_vector(const Joint& joint, const double* before, const double* now) {
  if (joint.kind != JointKind::ball) return Vec3(now[joint.coord] - before[joint.coord], 0.0, 0.0);
  return to_rotation_vector(ball_step(before + joint.coord, now + joint.coord));
}

double likeness_rad(const Joint& joint, const double* before, const double* now) {
  const double step = joint_step(joint, before, now);
  return joint.kind == JointKind::prismatic ? kRadPerMetre * step : step;
}

std::string_view unit_of(const Joint& joint, std::string_view angular, std::string_view linear) {
  return joint.kind == JointKind::prismatic ? linear : angular;
}

int moving_joint_count(const Character& character) { return static_cast<int>(character.joints().size()) - 1; }

Subject moving_joint(const Character& character, int subject, std::string_view angular, std::string_view linear) {
  const Joint& joint = character.joints()[static_cast<std::size_t>(subject) + 1];
  return {joint.name, unit_of(joint, angular, linear)};
}

}  // namespace contort
