// joint_range. Hinges and prismatic joints: distance to either end of the interval. Ball joints: swing and twist in the
// limit frame. With q the rotation from the limit frame and t the twist axis, q = swing * twist, twist about t and
// swing about an axis across it (Grassia, "Practical Parameterization of Rotations Using the Exponential Map", 1998).
// The swing's rotation vector lies in the plane across t; its margin is the distance to the ellipse along that vector.
#include <algorithm>
#include <cmath>

#include "checks/check.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

int subjects_of(const Joint& joint) {
  switch (joint.kind) {
    case JointKind::root: return 0;
    case JointKind::ball: return 3;
    case JointKind::hinge:
    case JointKind::prismatic: return 2;
  }
  return 0;
}

double swing_margin(const Joint& joint, const Vec3& swing_rad) {
  const double a = glm::dot(swing_rad, joint.swing_axis);
  const double b = glm::dot(swing_rad, glm::cross(joint.axis, joint.swing_axis));
  const double angle = std::sqrt(a * a + b * b);
  if (angle < 1e-9) return std::min(joint.swing_a_rad, joint.swing_b_rad);
  const double ea = a / joint.swing_a_rad;
  const double eb = b / joint.swing_b_rad;
  const double reach = angle / std::sqrt(ea * ea + eb * eb);  // the ellipse's radius in this direction
  return reach - angle;
}

void report_ball(const Joint& joint, const double* coords, int subject, int frame, MarginFold& fold) {
  const Quat q = glm::conjugate(joint.swing_center) * Quat(coords[0], coords[1], coords[2], coords[3]);
  const Vec3 v(q.x, q.y, q.z);
  const double along = glm::dot(v, joint.axis);
  const double half_twist = det::atan2(along, q.w);  // of the twist (q.w, along * axis), which need not be unit
  double twist = 2.0 * half_twist;
  if (twist > kPi) twist -= 2.0 * kPi;
  if (twist < -kPi) twist += 2.0 * kPi;
  const det::SinCos half = det::sincos(half_twist);
  const Quat swing = q * Quat(half.cos, -half.sin * joint.axis.x, -half.sin * joint.axis.y, -half.sin * joint.axis.z);
  const Vec3 s(swing.x, swing.y, swing.z);
  const double sine = std::sqrt(glm::dot(s, s));
  const double angle = 2.0 * det::atan2(sine, std::fabs(swing.w));
  const Vec3 swing_rad = sine < 1e-12 ? Vec3(0.0) : s * ((swing.w < 0.0 ? -angle : angle) / sine);
  // NaN must not pass the small-angle branches above as "no swing".
  const double finite = q.w + v.x + v.y + v.z;
  fold.report(subject, frame, std::isfinite(finite) ? swing_margin(joint, swing_rad) : finite - finite);
  fold.report(subject + 1, frame, twist - joint.low);
  fold.report(subject + 2, frame, joint.high - twist);
}

}  // namespace

int joint_range_subject_count(const Character& character) {
  int count = 0;
  for (const Joint& joint : character.joints()) count += subjects_of(joint);
  return count;
}

Subject joint_range_subject(const Character& character, int subject) {
  for (const Joint& joint : character.joints()) {
    const int own = subjects_of(joint);
    if (subject >= own) {
      subject -= own;
      continue;
    }
    const char* ball_sides[] = {" swing", " twist min", " twist max"};
    const char* sides[] = {" min", " max"};
    return {joint.name + (joint.kind == JointKind::ball ? ball_sides[subject] : sides[subject]),
            joint.kind == JointKind::prismatic ? "m" : "rad"};
  }
  return {};
}

void joint_range_measure(const CheckInput& in, MarginFold& fold) {
  for (int frame = 0; frame < in.motion.frame_count; ++frame) {
    const double* row = in.motion.row(frame).data();
    int subject = 0;
    for (const Joint& joint : in.character.joints()) {
      const double* q = row + joint.coord;
      if (joint.kind == JointKind::ball) {
        report_ball(joint, q, subject, frame, fold);
      } else if (joint.kind != JointKind::root) {
        fold.report(subject, frame, q[0] - joint.low);
        fold.report(subject + 1, frame, joint.high - q[0]);
      }
      subject += subjects_of(joint);
    }
  }
}

}  // namespace contort
