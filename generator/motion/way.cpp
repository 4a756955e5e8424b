#include "generator/motion/way.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kPeak = 1.875;       // of a minimum-jerk blend, in its mean speed (timeline.h)
constexpr double kPeakAcceleration = 5.774;  // of the same, in its way over the square of its time: 10 / sqrt(3)
constexpr double kEase = 0.5;         // of a joint's greatest speed
constexpr double kStays = 1e-6;       // rad or m: the joint counts as being there already
constexpr double kPlace_m_s = 1.0;    // of the root or a foot, at most
constexpr double kTurn_rad_s = 2.0;

double time_s(double way, double greatest_speed) {
  return way > kStays ? kLeastWay_s + kPeak * way / greatest_speed : 0.0;
}

}  // namespace

double joint_way(const Joint& joint, const double* a, const double* b) {
  if (joint.kind == JointKind::root) return 0.0;
  if (joint.kind != JointKind::ball) return std::fabs(b[0] - a[0]);
  return rotation_angle(glm::conjugate(quat_at(a)) * quat_at(b));
}

Vec3 joint_way_vector(const Joint& joint, const double* a, const double* b) {
  if (joint.kind == JointKind::root) return Vec3(0.0);
  if (joint.kind != JointKind::ball) return Vec3(b[0] - a[0], 0.0, 0.0);
  return to_rotation_vector(glm::conjugate(quat_at(a)) * quat_at(b));
}

double way_s(const Rigid& from, const Rigid& to) {
  return std::max(time_s(length(to.p_m - from.p_m), kPlace_m_s),
                  time_s(rotation_angle(glm::conjugate(from.q) * to.q), kTurn_rad_s));
}

double way_s(const Character& character, std::size_t part, const Posture& from, const Posture& to,
             std::span<const double> easy) {
  double most = part == 0 ? way_s(from.root, to.root) : 0.0;
  const Part& own = character.parts()[part];
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j)
    if (const Joint& joint = character.joint(j); joint.kind != JointKind::root) {
      const double way = joint_way(joint, from.coords.data() + joint.coord, to.coords.data() + joint.coord);
      most = std::max(most, time_s(way, kEase * joint.max_speed));
      if (!easy.empty()) most = std::max(most, std::sqrt(kPeakAcceleration * way / easy[at(j)]));
    }
  return most;
}

}  // namespace contort
