#include "import/robot_linkage.h"

#include <algorithm>
#include <cmath>

#include "formats/robot/shapes.h"
#include "import/fit.h"
#include "model/core/index.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

constexpr double kGreatestTurn_rad = 2.0 * kPi;  // a character's ranges end at 360 degrees
constexpr double kGreatestTravel_m = 10.0;
constexpr double kUndeclaredSpeed_deg_s = 3000.0;  // as for other imported models
constexpr double kUndeclaredSpeed_m_s = 10.0;

// Converts from a robot's axes (+X forward, +Y left, +Z up) to a character's (+Z forward, +X left, +Y up).
Vec3 turned(const Vec3& v) { return {v.y, v.z, v.x}; }
Quat turned(const Quat& q) { return {q.w, q.y, q.z, q.x}; }
Rigid turned(const Rigid& r) { return {turned(r.q), turned(r.p_m)}; }
Mat3 turned(const Mat3& m) {
  Mat3 out;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) out[column][row] = m[(column + 1) % 3][(row + 1) % 3];
  return out;
}

ColliderShape turned(const ColliderShape& shape) {
  struct Turn {
    ColliderShape operator()(const Sphere& s) const { return Sphere{turned(s.center_m), s.radius_m}; }
    ColliderShape operator()(const Capsule& c) const { return Capsule{turned(c.a_m), turned(c.b_m), c.radius_m}; }
    ColliderShape operator()(const Box& b) const {
      return Box{turned(b.center_m), turned(b.half_m), turned(b.rotation_deg)};
    }
    ColliderShape operator()(ConvexHull hull) const {
      for (Vec3& p : hull.points_m) p = turned(p);
      return hull;
    }
  };
  return std::visit(Turn{}, shape);
}

// A capsule with about the same inertia: it approximates the ellipsoid with the body's mass and moments.
std::optional<Capsule> capsule_of(const BodyInertia& body) {
  if (!(body.mass_kg > 0.0)) return {};
  const Eigen3 eigen = eigen_of(body.inertia_kg_m2);
  Vec3 half_m(0.0);
  const double sum = eigen.values[0] + eigen.values[1] + eigen.values[2];
  for (int i = 0; i < 3; ++i)
    half_m[i] = std::sqrt(std::max(2.5 / body.mass_kg * (sum - 2.0 * eigen.values[at(i)]), 0.0));
  int longest = 0;
  for (int i = 1; i < 3; ++i)
    if (half_m[i] > half_m[longest]) longest = i;
  const double radius_m = std::sqrt(half_m[(longest + 1) % 3] * half_m[(longest + 2) % 3]);
  const Vec3 reach_m = eigen.vectors[at(longest)] * std::max(half_m[longest] - radius_m, 0.0);
  const Capsule out{body.center_m - reach_m, body.center_m + reach_m, radius_m};
  return is_solid(out) && radius_m < 5.0 ? std::optional<Capsule>(out) : std::nullopt;
}

class LinkageMaker {
 public:
  explicit LinkageMaker(const RobotModel& robot) : robot_(robot) {}

  Linkage make() {
    out_.notes = robot_.notes;
    for (std::size_t i = 0; i < robot_.bodies.size(); ++i) add_body(robot_.bodies[i]);
    return std::move(out_);
  }

 private:
  // Adds a body and its joints. Its frame is relative to the link that carries it.
  void add_body(const RobotBody& body) {
    Rigid link_from_body = {turned(body.parent_from_body.q), Vec3(0.0)};
    int link = -1;
    if (body.parent >= 0) {
      link = out_.link_of_body[at(body.parent)];
      link_from_body = link_from_body_[at(body.parent)] * turned(body.parent_from_body);
    }
    RobotLink moving{.body = body.name, .parent = link};
    for (const RobotJoint& joint : body.joints) add_joint(joint, moving, link_from_body);
    if (link < 0 || !moving.joints.empty()) {
      link = static_cast<int>(out_.links.size());
      out_.links.push_back(std::move(moving));
    }
    out_.link_of_body.push_back(link);
    link_from_body_.push_back(link_from_body);
    add_solids(body, out_.links[at(link)], link_from_body);
  }

  // The rest pose of a character must be within all ranges. If the file's pose is not, the middle of the range is used,
  // or its only end.
  static double rest_of(const RobotJoint& joint) {
    if (joint.kind == RobotJointKind::ball) return 0.0;
    if (joint.low <= joint.at_rest && joint.at_rest <= joint.high) return joint.at_rest;
    if (joint.low == -kNoLimit || joint.high == kNoLimit) return joint.low == -kNoLimit ? joint.high : joint.low;
    return 0.5 * (joint.low + joint.high);
  }

  static Rigid motion_of(const RobotJoint& joint, double by) {
    const Vec3 axis = turned(joint.axis);
    if (joint.kind == RobotJointKind::travel) return {kNoRotation, axis * by};
    return {by == 0.0 ? kNoRotation : axis_angle(axis, by), Vec3(0.0)};
  }

  void add_joint(const RobotJoint& joint, RobotLink& link, Rigid& link_from_body) {
    const Vec3 anchor_m = turned(joint.anchor_m);
    const double rest = rest_of(joint);
    const bool is_locked = joint.kind != RobotJointKind::ball && joint.low >= joint.high;
    const Rigid frame = link_from_body * Rigid{kNoRotation, anchor_m} * motion_of(joint, rest - joint.at_rest);
    RobotJointReport report{joint.name, "", joint, rest, ""};
    if (rest != joint.at_rest)
      report.remark = "0 of the character is " + number_text(rest) + " of the file, as " + number_text(joint.at_rest) +
                      " is out of range";
    if (!joint.follows.empty())
      report.remark += (report.remark.empty() ? "" : "; ") + std::string("follows ") + joint.follows + " * " +
                       number_text(joint.multiplier) + " + " + number_text(joint.offset) +
                       ", which a character cannot express: it moves on its own";
    if (is_locked) {
      report.remark = "its range is a point: it is fixed";
      link_from_body = frame * Rigid{kNoRotation, -anchor_m};
    } else {
      link.joints.push_back(joint_desc(joint, rest, frame, report));
      link.reports.push_back(static_cast<int>(out_.reports.size()));
      link_from_body = {kNoRotation, -anchor_m};
    }
    out_.reports.push_back(std::move(report));
  }

  static void remark(RobotJointReport& report, const std::string& text) {
    report.remark += (report.remark.empty() ? "" : "; ") + text;
  }

  static JointDesc joint_desc(const RobotJoint& joint, double rest, const Rigid& frame, RobotJointReport& report) {
    JointDesc out;
    out.position_m = frame.p_m;
    out.rotation_deg = to_rotation_vector(frame.q) * kDegPerRad;
    out.axis = glm::normalize(turned(joint.axis));
    if (joint.kind == RobotJointKind::ball)
      set_ball(joint, out, report);
    else
      set_range(joint, rest, out, report);
    const bool travels = joint.kind == RobotJointKind::travel;
    if (!(joint.greatest_speed > 0.0)) remark(report, "no greatest speed is declared");
    if (!travels) {
      const double declared_deg_s = joint.greatest_speed * kDegPerRad;
      out.max_speed_deg_s = std::clamp(declared_deg_s > 0.0 ? declared_deg_s : kUndeclaredSpeed_deg_s, 1.0, 1e5);
    } else {
      out.max_speed_m_s =
          std::clamp(joint.greatest_speed > 0.0 ? joint.greatest_speed : kUndeclaredSpeed_m_s, 1e-3, 1e3);
    }
    return out;
  }

  static void set_ball(const RobotJoint& joint, JointDesc& out, RobotJointReport& report) {
    const double most_deg = joint.high == kNoLimit || !(joint.high > 0.0) ? 180.0 : joint.high * kDegPerRad;
    out.type = JointType::ball;
    out.axis = Vec3(0, 1, 0);
    out.swing_axis = Vec3(1, 0, 0);
    out.swing_deg = {std::clamp(most_deg, 0.1, 180.0), std::clamp(most_deg, 0.1, 180.0)};
    out.low_deg = -std::clamp(most_deg, 0.1, 180.0);
    out.high_deg = -out.low_deg;
    if (joint.high != kNoLimit) remark(report, "the limit of the whole angle is taken for swing and for twist");
  }

  static void set_range(const RobotJoint& joint, double rest, JointDesc& out, RobotJointReport& report) {
    const bool travels = joint.kind == RobotJointKind::travel;
    const double most = travels ? kGreatestTravel_m : kGreatestTurn_rad;
    const double low = std::max(joint.low - rest, -most), high = std::min(joint.high - rest, most);
    if (low > joint.low - rest || high < joint.high - rest)
      remark(report, std::string(joint.low == -kNoLimit && joint.high == kNoLimit ? "it has no limits; " : "") +
                         "ranges of a character end at " + (travels ? "10 m" : "360 degrees"));
    out.type = travels ? JointType::prismatic : JointType::hinge;
    if (travels) {
      out.low_deg = JointDesc{}.low_deg, out.high_deg = JointDesc{}.high_deg;
      out.low_m = low, out.high_m = high;
    } else {
      out.low_deg = std::max(low * kDegPerRad, -360.0), out.high_deg = std::min(high * kDegPerRad, 360.0);
    }
  }

  void add_solids(const RobotBody& body, RobotLink& link, const Rigid& link_from_body) {
    const BodyInertia own{body.inertia.mass_kg, turned(body.inertia.center_m), turned(body.inertia.inertia_kg_m2)};
    link.inertia = own.mass_kg > 0.0 ? merged(link.inertia, moved(link_from_body, own)) : link.inertia;
    bool needs_guess = false, has_shape = false;
    for (const RobotShape& shape : body.shapes) {
      needs_guess = needs_guess || !shape.mesh.empty();
      if (!shape.mesh.empty()) continue;
      has_shape = true;
      link.shapes.push_back(
          {body.name, moved_shape(link_from_body, turned(shape.shape)), shape.groups, shape.partners, false});
    }
    if (!needs_guess || has_shape) return;
    if (const std::optional<Capsule> capsule = capsule_of(own)) {
      const RobotShape& mesh = body.shapes.front();
      link.shapes.push_back({body.name, moved_shape(link_from_body, *capsule), mesh.groups, mesh.partners, true});
    } else {
      out_.notes.push_back("RobotLink " + body.name +
                           " has no collider: its mesh was not read, and it has no inertia.");
    }
  }

  const RobotModel& robot_;
  Linkage out_;
  std::vector<Rigid> link_from_body_;
};

}  // namespace

Linkage linkage_of(const RobotModel& robot) { return LinkageMaker(robot).make(); }

}  // namespace contort
