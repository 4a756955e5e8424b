#include "cli/robot_joints.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

#include "model/core/index.h"

namespace contort::cli {

namespace {

constexpr double kMost_deg = 360.0, kLeastSpeed_deg_s = 1.0, kGreatestSpeed_deg_s = 1e5;
constexpr double kUnknownSpeed_deg_s = 3000.0;  // as in an import
constexpr double kMostMultiplier = 1000.0, kMostOffset_rad = 20.0 * kPi;  // greatest values in a manifest

std::array<double, 4> in_order(const Quat& q) { return {q.x, q.y, q.z, q.w}; }

const RobotJoint* only_joint(const RobotBody& body) { return body.joints.size() == 1 ? &body.joints[0] : nullptr; }

// The rest pose is the file's if that is within the range, otherwise the middle of the range.
double rest_of(const RobotJoint& joint) {
  const bool is_within = joint.low <= joint.at_rest && joint.at_rest <= joint.high;
  return is_within || !std::isfinite(joint.low + joint.high) ? joint.at_rest : 0.5 * (joint.low + joint.high);
}

double degrees(double angle_rad) { return std::clamp(angle_rad * kDegPerRad, -kMost_deg, kMost_deg); }

void set_limits(const RobotJoint& from, GuestJoint& out) {
  const double rest = rest_of(from);
  out.max_speed_deg_s = from.greatest_speed > 0.0 ? std::clamp(from.greatest_speed * kDegPerRad, kLeastSpeed_deg_s,
                                                               kGreatestSpeed_deg_s)
                                                  : kUnknownSpeed_deg_s;
  if (from.kind == RobotJointKind::travel) out.type = GuestJointType::fixed;
  if (from.kind == RobotJointKind::ball && std::isfinite(from.high))
    out.swing_deg = std::clamp(from.high * kDegPerRad, 0.1, 180.0);
  if (from.kind != RobotJointKind::hinge) return;
  out.type = GuestJointType::hinge, out.axis = from.axis;
  out.low_deg = degrees(from.low - rest), out.high_deg = degrees(from.high - rest);
}

// A shape that becomes a collider of the guest, with MJCF's contype and conaffinity.
struct JudgedShape {
  std::string name;
  std::size_t body = 0;
  unsigned groups = 1;
  unsigned partners = 1;
};

// Makes the joints. The frames of a guest have their origins at the joints' anchors, so bodies are placed relative to
// these.
class RobotJoints {
 public:
  explicit RobotJoints(const RobotModel& robot) : robot_(robot) {}

  GuestCharacter character() {
    for (std::size_t b = 0; b < robot_.bodies.size(); ++b) add_body(b);
    for (std::size_t b = 1; b < robot_.bodies.size(); ++b) add_follower(b);
    for (const RobotPair& pair : robot_.may_touch) allow_bodies(find_body(robot_, pair.a), find_body(robot_, pair.b));
    allow_groups();
    out_.may_touch.assign(may_touch_.begin(), may_touch_.end());
    return std::move(out_);
  }

 private:
  Vec3 anchor(std::size_t b) const {
    const RobotJoint* joint = b == 0 ? nullptr : only_joint(robot_.bodies[b]);
    return joint == nullptr ? Vec3(0.0) : joint->anchor_m;
  }

  std::string name_for(std::size_t b) {
    const RobotJoint* joint = b == 0 ? nullptr : only_joint(robot_.bodies[b]);
    std::string name = joint == nullptr || joint->name.empty() ? robot_.bodies[b].name : joint->name;
    if (taken_.contains(name)) name = robot_.bodies[b].name;
    for (int n = 2; !taken_.insert(name).second; ++n) name = robot_.bodies[b].name + "_" + std::to_string(n);
    return name;
  }

  void add_body(std::size_t b) {
    const RobotBody& body = robot_.bodies[b];
    GuestJoint joint;
    joint.name = name_for(b), joint.body = joint.name == body.name ? "" : body.name;
    Rigid place = body.parent_from_body;
    place.p_m = place * anchor(b) - (body.parent < 0 ? Vec3(0.0) : anchor(at(body.parent)));
    if (body.parent >= 0) joint.parent = out_.joints[at(body.parent)].name;
    if (b > 0 && body.joints.empty()) joint.type = GuestJointType::fixed;
    if (const RobotJoint* only = b == 0 ? nullptr : only_joint(body)) {
      set_limits(*only, joint);
      if (only->kind == RobotJointKind::hinge)
        place.q = place.q * axis_angle(only->axis, rest_of(*only) - only->at_rest);
    }
    joint.position = place.p_m, joint.rotation = in_order(place.q);
    out_.joints.push_back(joint);
    shapes_of_.emplace_back();
    for (const RobotShape& shape : body.shapes) add_shape(shape, b);
  }

  void add_shape(const RobotShape& from, std::size_t b) {
    if (!from.mesh.empty()) return;
    GuestCollider out;
    const Vec3 moved = -anchor(b);
    if (const auto* ball = std::get_if<Sphere>(&from.shape))
      out.from = out.to = ball->center_m + moved, out.radius = ball->radius_m;
    else if (const auto* capsule = std::get_if<Capsule>(&from.shape))
      out.from = capsule->a_m + moved, out.to = capsule->b_m + moved, out.radius = capsule->radius_m;
    else if (const auto* box = std::get_if<Box>(&from.shape))
      out.type = GuestShape::box, out.center = box->center_m + moved, out.half = box->half_m,
      out.rotation = in_order(from_rotation_vector(box->rotation_deg * kRadPerDeg));
    else
      return;
    out.joint = out_.joints[b].name;
    out.name = robot_.bodies[b].name + "_" + std::to_string(shapes_of_[b].size() + 1);
    shapes_of_[b].push_back(shapes_.size());
    shapes_.push_back({out.name, b, from.groups, from.partners});
    out_.colliders.push_back(out);
  }

  // Returns the only joint of a body if it is a hinge, otherwise null.
  const RobotJoint* hinge_of(std::size_t b) const {
    const RobotJoint* joint = only_joint(robot_.bodies[b]);
    return joint != nullptr && joint->kind == RobotJointKind::hinge ? joint : nullptr;
  }

  // Converts angles of the file to angles from rest. Travels are fixed here, so they neither lead nor follow.
  void add_follower(std::size_t b) {
    const RobotJoint* own = hinge_of(b);
    if (own == nullptr || own->follows.empty() || own->follows == own->name) return;
    for (std::size_t other = 1; other < robot_.bodies.size(); ++other) {
      const RobotJoint* leader = hinge_of(other);
      if (leader == nullptr || leader->name != own->follows) continue;
      const double offset_rad = own->multiplier * rest_of(*leader) + own->offset - rest_of(*own);
      if (std::fabs(own->multiplier) <= kMostMultiplier && std::fabs(offset_rad) <= kMostOffset_rad)
        out_.joints[b].follows = {out_.joints[other].name, own->multiplier, offset_rad * kDegPerRad};
      return;
    }
  }

  void allow(const JudgedShape& one, const JudgedShape& other) {
    may_touch_.insert({std::min(one.name, other.name), std::max(one.name, other.name)});
  }

  void allow_bodies(int a, int b) {
    if (a < 0 || b < 0) return;
    for (const std::size_t one : shapes_of_[at(a)])
      for (const std::size_t other : shapes_of_[at(b)]) allow(shapes_[one], shapes_[other]);
  }

  // MJCF: shapes of different bodies collide if the groups of one meet the partners of the other.
  void allow_groups() {
    for (std::size_t a = 0; a < shapes_.size(); ++a)
      for (std::size_t b = a + 1; b < shapes_.size(); ++b) {
        const JudgedShape &one = shapes_[a], &other = shapes_[b];
        const bool meet = (one.groups & other.partners) != 0 || (other.groups & one.partners) != 0;
        if (!meet && one.body != other.body) allow(one, other);
      }
  }

  const RobotModel& robot_;
  GuestCharacter out_;
  std::set<std::string> taken_;
  std::vector<JudgedShape> shapes_;
  std::vector<std::vector<std::size_t>> shapes_of_;  // by body: indices of its shapes
  std::set<std::array<std::string, 2>> may_touch_;
};

}  // namespace

GuestCharacter joints_of_robot(const RobotModel& robot) { return RobotJoints(robot).character(); }

}  // namespace contort::cli
