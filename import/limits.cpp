#include "import/limits.h"

#include <algorithm>

#include "import/fit.h"
#include "import/roles.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kMargin = 0.1;      // a range from clips is widened by this fraction
constexpr double kMargin_deg = 5.0;  // and at least by this
constexpr double kMoves_deg = 2.0;   // a bone that turns less in clips shows nothing about its range
constexpr double kBent_deg = 10.0;   // a knee or elbow that is bent more at rest shows its axis
constexpr double kGenericSwing_deg = 45.0, kGenericTwist_deg = 30.0, kGenericHinge_deg = 60.0;

// ---- the table for people, with hanging arms; sources as in docs/reference/characters.md

struct BallRow {
  BoneRole role;
  Vec3 neutral;  // direction of the bone in that stance; 0: its direction at rest
  Vec3 center_deg;
  Vec3 swing_axis;
  std::array<double, 2> swing_deg;
  double low_deg;
  double high_deg;
  bool shared;  // the range is divided among all bones of that role
};
const BallRow kTable[] = {
    // Lumbar flexion 75, extension 30, to the sides 35, turning 38.
    {BoneRole::spine, {0, 1, 0}, {22.5, 0, 0}, {1, 0, 0}, {52.5, 35}, -38, 38, true},
    {BoneRole::neck, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {55, 40}, -70, 70, true},
    {BoneRole::head, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {55, 40}, -70, 70, true},
    // Assumed: a collar bone lifts 40, drops 10 and goes 25 forward or back; half of that spread each way.
    {BoneRole::clavicle, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {30, 30}, -20, 20, false},
    // The cone of the stock human's shoulder.
    {BoneRole::upper_arm, {0, -1, 0}, {-42, 0, 56}, {-0.6, 0, 0.8}, {115, 105}, -110, 80, false},
    // Flexion 125, extension 30, abduction 45, adduction 25, rotation 40 and 60, as one cone.
    {BoneRole::thigh, {0, -1, 0}, {-47.5, 0, 10}, {1, 0, 0}, {90, 50}, -60, 60, false},
    // Flexion 80, extension 70. The direction of the palm is unknown, so the cone is round. The forearm's own rotation,
    // 80 each way, is included here.
    {BoneRole::hand, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {80, 80}, -85, 85, false},
};
constexpr double kElbow_deg = 150.0, kKnee_deg = 140.0;
constexpr double kAnkleDown_deg = -45.0, kAnkleUp_deg = 35.0, kAnkleOut_deg = -20.0, kAnkleIn_deg = 35.0;

double outward(double deg) { return deg < 0.0 ? std::floor(deg * 10.0) / 10.0 : std::ceil(deg * 10.0) / 10.0; }
double margin(double deg) { return std::max(kMargin * std::fabs(deg), kMargin_deg); }

double twist_rad(const Quat& q, const Vec3& axis) {
  return wrap_angle(2.0 * det::atan2(glm::dot(axis, Vec3(q.x, q.y, q.z)), q.w));
}

// The rotation without its twist, as a rotation vector at a right angle to the axis.
Vec3 swing_of(const Quat& q, const Vec3& axis) {
  return to_rotation_vector(q * glm::conjugate(axis_angle(axis, twist_rad(q, axis))));
}

bool moves(const std::vector<Quat>& poses) {
  return std::any_of(poses.begin(), poses.end(),
                     [](const Quat& q) { return rotation_angle(q) > kMoves_deg * kRadPerDeg; });
}

// ---- balls

// The smallest ellipse, with the proportions of its bounding box, that contains all swings as seen from the limit
// frame.
struct SwingFit {
  double a_rad = 0.0;
  double b_rad = 0.0;
  double low_rad = 0.0;  // lowest twist
  double high_rad = 0.0;
};

SwingFit fit_swings(const std::vector<Quat>& poses, const Quat& center, const Vec3& axis, const Vec3& u,
                    const Vec3& v) {
  SwingFit out;
  std::vector<Vec3> swings;
  for (const Quat& q : poses) {
    const Quat seen = glm::conjugate(center) * q;
    const double twist = twist_rad(seen, axis);
    out.low_rad = std::min(out.low_rad, twist), out.high_rad = std::max(out.high_rad, twist);
    swings.push_back(swing_of(seen, axis));
    out.a_rad = std::max(out.a_rad, std::fabs(glm::dot(swings.back(), u)));
    out.b_rad = std::max(out.b_rad, std::fabs(glm::dot(swings.back(), v)));
  }
  out.a_rad = std::max({out.a_rad, 0.2 * out.b_rad, 1e-3}), out.b_rad = std::max({out.b_rad, 0.2 * out.a_rad, 1e-3});
  double scale = 1.0;
  for (const Vec3& s : swings) {
    const double a = glm::dot(s, u) / out.a_rad, b = glm::dot(s, v) / out.b_rad;
    scale = std::max(scale, std::sqrt(a * a + b * b));
  }
  out.a_rad *= scale, out.b_rad *= scale;
  return out;
}

BoneJoint ball_from_clips(const Vec3& axis, std::vector<Quat> poses) {
  poses.push_back(kNoRotation);  // the rest pose is always in range
  const Vec3 side = perpendicular(axis), other = glm::cross(axis, side);
  Mat3 spread(0.0);
  for (const Quat& q : poses) {
    const Vec3 swing = swing_of(q, axis);
    spread += glm::outerProduct(swing, swing);
  }
  const Vec3 main = eigen_of(spread).vectors[0];
  const Vec3 u = unit_or(glm::dot(main, side) * side + glm::dot(main, other) * other, side), v = glm::cross(axis, u);
  Vec3 low(0.0), high(0.0);
  for (const Quat& q : poses) {
    const Vec3 swing = swing_of(q, axis), seen(glm::dot(swing, u), glm::dot(swing, v), 0.0);
    low = glm::min(low, seen), high = glm::max(high, seen);
  }
  const Vec3 middle = 0.5 * (low + high);
  BoneJoint out;
  out.axis = axis, out.swing_axis = u;
  for (int i = 0; i < 3; ++i) out.swing_center_deg[i] = on_lattice((middle.x * u + middle.y * v)[i] * kDegPerRad, 10.0);
  const Quat center = from_rotation_vector(out.swing_center_deg * kRadPerDeg);
  const SwingFit fit = fit_swings(poses, center, axis, u, v);
  const auto wide = [](double rad) { return std::min(outward(rad * kDegPerRad + margin(rad * kDegPerRad)), 180.0); };
  out.swing_deg = {wide(fit.a_rad), wide(fit.b_rad)};
  out.low_deg = -wide(-fit.low_rad), out.high_deg = wide(fit.high_rad);
  out.source = LimitSource::clips;
  return out;
}

BoneJoint generic_ball(const Vec3& axis) {
  BoneJoint out;
  out.axis = axis, out.swing_axis = perpendicular(axis);
  out.swing_deg = {kGenericSwing_deg, kGenericSwing_deg};
  out.low_deg = -kGenericTwist_deg, out.high_deg = kGenericTwist_deg;
  return out;
}

// The distance of a rotation from the centre, as a fraction of a ball's range; <= 1 is inside.
double share_of_range(const BoneJoint& joint, const Quat& q) {
  const Quat seen = glm::conjugate(from_rotation_vector(joint.swing_center_deg * kRadPerDeg)) * q;
  const Vec3 swing = swing_of(seen, joint.axis) * kDegPerRad;
  const double a = glm::dot(swing, joint.swing_axis) / joint.swing_deg[0];
  const double b = glm::dot(swing, glm::cross(joint.axis, joint.swing_axis)) / joint.swing_deg[1];
  const double twist = twist_rad(seen, joint.axis) * kDegPerRad;
  return std::max({std::sqrt(a * a + b * b), twist / joint.high_deg, twist / joint.low_deg});
}

int count_of(const RiggedFigure& figure, const Bone& like) {
  const auto is_neck = [](BoneRole r) { return r == BoneRole::neck || r == BoneRole::head; };
  int count = 0;
  for (std::size_t b = 1; b < figure.bones.size(); ++b) {
    const Bone& bone = figure.bones[b];
    count +=
        bone.family != BoneFamily::unknown && (bone.role == like.role || (is_neck(bone.role) && is_neck(like.role)));
  }
  return std::max(count, 1);
}

BoneJoint ball_from_table(const RiggedFigure& figure, const Bone& bone, const BallRow& row, const Vec3& axis) {
  // The bone at rest differs from the table's stance by this rotation, and the range is rotated in the same way.
  const bool follows = row.neutral == Vec3(0.0);
  const Quat rest_from_neutral = follows ? kNoRotation : shortest_arc(row.neutral, axis);
  const Quat center = from_rotation_vector(row.center_deg * kRadPerDeg) * glm::conjugate(rest_from_neutral);
  const double share = row.shared ? 1.0 / count_of(figure, bone) : 1.0;
  BoneJoint out;
  out.axis = axis;
  out.swing_axis = follows ? perpendicular(axis) : rest_from_neutral * row.swing_axis;
  for (std::size_t i = 0; i < 2; ++i) out.swing_deg[i] = outward(share * row.swing_deg[i]);
  out.low_deg = -outward(-share * row.low_deg), out.high_deg = outward(share * row.high_deg);
  const Vec3 turn = to_rotation_vector(center) * kDegPerRad;
  // A bone of the spine takes its share of the centre, a bone of a limb the whole centre.
  for (int i = 0; i < 3; ++i)
    out.swing_center_deg[i] = on_lattice(row.shared ? share * row.center_deg[i] : turn[i], 10.0);
  out.source = LimitSource::table;
  // If the rest pose is outside of the human range, the range grows until it contains it.
  if (const double over = share_of_range(out, kNoRotation); over > 0.95) {
    for (double& half : out.swing_deg) half = std::min(outward(half * (over + 0.05)), 180.0);
    out.low_deg = std::max(outward(out.low_deg * (over + 0.05)), -180.0);
    out.high_deg = std::min(outward(out.high_deg * (over + 0.05)), 180.0);
  }
  return out;
}

BoneJoint ball_of(const RiggedFigure& figure, int index, const std::vector<Quat>& poses) {
  const Bone& bone = bone_at(figure, index);
  const Vec3 axis = direction_of(figure, index);
  if (figure.is_humanoid)
    for (const BallRow& row : kTable)
      if (row.role == bone.role && bone.family != BoneFamily::unknown) return ball_from_table(figure, bone, row, axis);
  return moves(poses) ? ball_from_clips(axis, poses) : generic_ball(axis);
}

// ---- hinges

// The axis about which clips turn a bone, if most of its rotation is about one axis; otherwise 0.
Vec3 axis_of_clips(const std::vector<Quat>& poses) {
  constexpr double kMostly = 0.85;
  constexpr double kEnough_deg = 15.0;
  Mat3 spread(0.0);
  double most = 0.0;
  for (const Quat& q : poses) {
    const Vec3 r = to_rotation_vector(q);
    spread += glm::outerProduct(r, r), most = std::max(most, length(r));
  }
  const Eigen3 eigen = eigen_of(spread);
  const double sum = eigen.values[0] + eigen.values[1] + eigen.values[2];
  return most > kEnough_deg * kRadPerDeg && eigen.values[0] > kMostly * sum ? eigen.vectors[0] : Vec3(0.0);
}

// The axis of a person's elbow or knee. Positive angles bend further: forearms forward, shanks backward.
Vec3 anatomical_axis(const Vec3& upper, BoneRole role) {
  const Vec3 toward(0.0, 0.0, role == BoneRole::forearm ? 1.0 : -1.0);
  return unit_or(glm::cross(upper, toward), Vec3(role == BoneRole::forearm ? -1.0 : 1.0, 0.0, 0.0));
}

double bend_rad(const Vec3& upper, const Vec3& lower, const Vec3& axis) {
  return det::atan2(glm::dot(axis, glm::cross(upper, lower)), glm::dot(upper, lower));
}

BoneJoint hinge_of(const RiggedFigure& figure, int index, const std::vector<Quat>& poses) {
  const Bone& bone = bone_at(figure, index);
  const Vec3 upper = direction_of(figure, bone.parent), lower = direction_of(figure, index);
  const Vec3 bent = glm::cross(upper, lower), seen = axis_of_clips(poses);
  const bool is_bent = length(bent) > det::sin(kBent_deg * kRadPerDeg);
  const Vec3 expected = is_bent ? glm::normalize(bent) : anatomical_axis(upper, bone.role);
  BoneJoint out;
  out.type = JointType::hinge;
  out.axis = length(seen) > 0.0 ? glm::dot(seen, expected) < 0.0 ? -seen : seen : expected;
  out.low_deg = -kGenericHinge_deg, out.high_deg = kGenericHinge_deg;
  double low = 0.0, high = 0.0;
  for (const Quat& q : poses) {
    const double angle = twist_rad(q, out.axis) * kDegPerRad;
    low = std::min(low, angle), high = std::max(high, angle);
  }
  if (moves(poses)) {
    out.low_deg = std::max(-outward(-low + margin(high - low)), -180.0);
    out.high_deg = std::min(outward(high + margin(high - low)), 180.0), out.source = LimitSource::clips;
  }
  if (!figure.is_humanoid || bone.role == BoneRole::hock) return out;
  const double bend = bend_rad(upper, lower, out.axis) * kDegPerRad;
  out.low_deg = std::min(-outward(bend), 0.0);
  out.high_deg = std::max(outward((bone.role == BoneRole::forearm ? kElbow_deg : kKnee_deg) - bend), 10.0);
  out.source = LimitSource::table;
  out.leaves_table = low < out.low_deg || high > out.high_deg;
  return out;
}

// ---- ankles: up and down, then the sole inward and outward

BoneJoint ankle_of(const RiggedFigure& figure, const std::vector<Quat>& poses) {
  BoneJoint out;
  out.type = JointType::hinge, out.is_pair = true;
  out.axis = Vec3(-1, 0, 0), out.second_axis = Vec3(0, 0, -1);
  out.low_deg = kAnkleDown_deg, out.high_deg = kAnkleUp_deg;
  out.second_low_deg = kAnkleOut_deg, out.second_high_deg = kAnkleIn_deg;
  double low = 0.0, high = 0.0, second_low = 0.0, second_high = 0.0;
  for (const Quat& q : poses) {
    const double flex = twist_rad(q, out.axis);
    const double roll = twist_rad(glm::conjugate(axis_angle(out.axis, flex)) * q, out.second_axis) * kDegPerRad;
    low = std::min(low, flex * kDegPerRad), high = std::max(high, flex * kDegPerRad);
    second_low = std::min(second_low, roll), second_high = std::max(second_high, roll);
  }
  if (figure.is_humanoid) {
    out.source = LimitSource::table;
    out.leaves_table = low < out.low_deg || high > out.high_deg;
  } else if (moves(poses)) {
    out.low_deg = std::max(-outward(-low + margin(high - low)), -180.0);
    out.high_deg = std::min(outward(high + margin(high - low)), 180.0);
    out.second_low_deg = std::max(-outward(-second_low + margin(second_high - second_low)), -180.0);
    out.second_high_deg = std::min(outward(second_high + margin(second_high - second_low)), 180.0);
    out.source = LimitSource::clips;
  }
  return out;
}

}  // namespace

bool is_sole_bone(const RiggedFigure& figure, int bone) {
  constexpr double kNear = 0.06;  // fraction of the height that a sole may be above the lowest vertex
  const Bone& own = bone_at(figure, bone);
  return own.role == BoneRole::foot && own.side != Side::center &&
         lowest_below_m(figure, bone) < figure.ground_m + kNear * figure.height_m;
}

BoneJoint joint_of(const RiggedFigure& figure, int index, const std::vector<Quat>& poses) {
  const BoneRole role = bone_at(figure, index).role;
  if (role == BoneRole::forearm || role == BoneRole::shank || role == BoneRole::hock)
    return hinge_of(figure, index, poses);
  if (is_sole_bone(figure, index)) return ankle_of(figure, poses);
  BoneJoint out = ball_of(figure, index, poses);
  if (out.source == LimitSource::table)
    out.leaves_table =
        std::any_of(poses.begin(), poses.end(), [&](const Quat& q) { return share_of_range(out, q) > 1.0; });
  return out;
}

namespace {

// The nearest rotation that the joint can reach.
Quat taken(const BoneJoint& joint, const Quat& q) {
  if (joint.type == JointType::ball) return q;
  const Quat first = axis_angle(joint.axis, twist_rad(q, joint.axis));
  if (!joint.is_pair) return first;
  return first * axis_angle(joint.second_axis, twist_rad(glm::conjugate(first) * q, joint.second_axis));
}

}  // namespace

ClipPoses followed(const RiggedFigure& figure, const ClipPoses& poses) {
  ClipPoses out = poses;
  const auto count = static_cast<std::size_t>(poses.pose_count);
  std::vector<std::vector<Quat>> missed(figure.bones.size(), std::vector<Quat>(count, kNoRotation));
  for (std::size_t b = 1; b < figure.bones.size(); ++b) {
    const auto parent = static_cast<std::size_t>(figure.bones[b].parent);
    for (std::size_t i = 0; i < count; ++i) out.turns[b][i] = missed[parent][i] * poses.turns[b][i];
    const BoneJoint joint = joint_of(figure, static_cast<int>(b), out.turns[b]);
    for (std::size_t i = 0; i < count; ++i)
      missed[b][i] = glm::conjugate(taken(joint, out.turns[b][i])) * out.turns[b][i];
  }
  return out;
}

}  // namespace contort
