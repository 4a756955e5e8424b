#include "generator/motion/joint_clamp.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/motion/way.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kInside_rad = 1e-9;  // a thousand times what a quaternion's rounding makes of an angle

struct Interval {
  double low;
  double high;
};

// The twist that a rotation can show: it is measured in [-pi, pi], so a wider range is none.
Interval twist_range(const Joint& ball) { return {std::max(ball.low, -kPi), std::min(ball.high, kPi)}; }

bool clamp_twist(const Joint& ball, double& twist_rad) {
  const auto [low, high] = twist_range(ball);
  const double inside = std::max(0.0, std::min(kInside_rad, 0.5 * (high - low)));
  // Half of it, so that a clamped twist is not clamped again. A range of one angle has no inside: rounding is let be.
  const double enough = 0.5 * inside - 1e-12;
  if (high - low > 2.0 * kPi - 2.0 * kInside_rad) return false;
  if (twist_rad >= low + enough && twist_rad <= high - enough) return false;
  const bool near_low = std::fabs(wrap_angle(twist_rad - low)) <= std::fabs(wrap_angle(twist_rad - high));
  twist_rad = near_low ? low + inside : high - inside;
  return true;
}

bool clamp_swing(const Joint& ball, SwingTwist& at) {
  const double ea = at.a_rad / ball.swing_a_rad;
  const double eb = at.b_rad / ball.swing_b_rad;
  const double share = std::sqrt(ea * ea + eb * eb);  // of the ellipse's radius in this direction
  const double angle = std::sqrt(at.a_rad * at.a_rad + at.b_rad * at.b_rad);
  const double inside = angle > 0.0 ? kInside_rad * share / angle : 0.0;  // the hair, as a share
  if (share <= 1.0 - 0.5 * inside) return false;
  const double scale = (1.0 - inside) / share;
  at.a_rad *= scale;
  at.b_rad *= scale;
  return true;
}

void clamp_ball(const Joint& ball, double* coords) {
  const Quat before(coords[0], coords[1], coords[2], coords[3]);
  const double square = glm::dot(before, before);
  if (!(square > 1e-12 && square < 1e12)) return set_swing_twist(ball, {}, coords);
  SwingTwist at = swing_twist_of(ball, coords);
  const bool twisted = clamp_twist(ball, at.twist_rad);
  const bool swung = clamp_swing(ball, at);
  if (!twisted && !swung) return;
  set_swing_twist(ball, at, coords);
  const Quat after(coords[0], coords[1], coords[2], coords[3]);
  if (glm::dot(before, after) >= 0.0) return;
  for (int i = 0; i < 4; ++i) coords[i] = -coords[i];  // the sign of before: neighbours in time stay neighbours
}

double interval_margin(double value, double low, double high) {
  return high > low ? 2.0 * std::min(value - low, high - value) / (high - low) : 1.0;
}

double ball_margin(const Joint& ball, const double* coords) {
  const SwingTwist at = swing_twist_of(ball, coords);
  const double ea = at.a_rad / ball.swing_a_rad;
  const double eb = at.b_rad / ball.swing_b_rad;
  const double swing = 1.0 - std::sqrt(ea * ea + eb * eb);
  const auto [low, high] = twist_range(ball);
  return std::min(swing, interval_margin(at.twist_rad, low, high));
}

}  // namespace

SwingTwist swing_twist_of(const Joint& ball, const double* coords) {
  const Quat q = glm::conjugate(ball.swing_center) * Quat(coords[0], coords[1], coords[2], coords[3]);
  const double along = glm::dot(Vec3(q.x, q.y, q.z), ball.axis);
  const double half_twist = det::atan2(along, q.w);
  const Vec3 swing_rad = to_rotation_vector(q * axis_angle(ball.axis, -2.0 * half_twist));
  const double twist = wrap_angle(2.0 * half_twist);
  return {glm::dot(swing_rad, ball.swing_axis), glm::dot(swing_rad, glm::cross(ball.axis, ball.swing_axis)), twist};
}

void set_swing_twist(const Joint& ball, const SwingTwist& at, double* coords) {
  const Vec3 swing_rad = at.a_rad * ball.swing_axis + at.b_rad * glm::cross(ball.axis, ball.swing_axis);
  const Quat swing = from_rotation_vector(swing_rad);
  const Quat q = glm::normalize(ball.swing_center * swing * axis_angle(ball.axis, at.twist_rad));
  coords[0] = q.w, coords[1] = q.x, coords[2] = q.y, coords[3] = q.z;
}

void clamp_to_range(const Joint& joint, double* coords) {
  if (joint.kind == JointKind::root) return;
  if (joint.kind == JointKind::ball) return clamp_ball(joint, coords);
  if (!std::isfinite(coords[0])) coords[0] = 0.5 * (joint.low + joint.high);
  coords[0] = std::clamp(coords[0], joint.low, joint.high);
}

bool is_in_range(const Joint& joint, std::span<const double> row) {
  constexpr double kInRange = 1e-10;
  if (joint.kind == JointKind::root) return true;
  const double* coords = row.data() + joint.coord;
  std::array<double, 4> clamped{};
  std::copy_n(coords, coord_size(joint.kind), clamped.begin());
  clamp_to_range(joint, clamped.data());
  return joint_way(joint, coords, clamped.data()) <= kInRange;
}

bool clamp_part(const Character& character, std::size_t part, Posture& posture) {
  constexpr double kMoved = 1e-4;
  bool moved = false;
  const Part& own = character.parts()[part];
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j) {
    const Joint& joint = character.joint(j);
    double* coords = posture.coords.data() + joint.coord;
    std::array<double, 4> wanted{};
    std::copy_n(coords, coord_size(joint.kind), wanted.begin());
    clamp_to_range(joint, coords);
    moved = moved || joint_way(joint, wanted.data(), coords) > kMoved;
  }
  return moved;
}

double normalised_margin(const Joint& joint, const double* coords) {
  if (joint.kind == JointKind::root) return 1.0;
  if (joint.kind == JointKind::ball) return ball_margin(joint, coords);
  return interval_margin(coords[0], joint.low, joint.high);
}

}  // namespace contort
