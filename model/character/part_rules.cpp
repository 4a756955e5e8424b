#include "model/character/part_rules.h"

#include <cmath>
#include <set>

#include "model/character/polyhedron.h"

namespace contort {

namespace {

constexpr double kUnitTolerance = 1e-6;

bool is_unit(const Vec3& v) { return std::fabs(glm::dot(v, v) - 1.0) <= kUnitTolerance; }

int index_of(const PartDesc& part, std::string_view joint) {
  for (std::size_t i = 0; i < part.joints.size(); ++i)
    if (part.joints[i].name == joint) return static_cast<int>(i);
  return -1;
}

bool has_socket(const PartDesc& part, std::string_view socket) {
  for (const SocketDesc& candidate : part.sockets)
    if (candidate.name == socket) return true;
  return false;
}

// Returns true if a body on `joint` moves when joint `carrier` does.
bool moves_with(const PartDesc& part, std::string_view joint, std::string_view carrier) {
  for (int i = index_of(part, joint); i >= 0; i = index_of(part, part.joints[static_cast<std::size_t>(i)].parent))
    if (part.joints[static_cast<std::size_t>(i)].name == carrier) return true;
  return false;
}

std::string_view joint_of_socket(const PartDesc& part, std::string_view socket) {
  for (const SocketDesc& candidate : part.sockets)
    if (candidate.name == socket) return candidate.joint;
  return "";
}

Issue issue_at(std::string code, const std::string& list, std::size_t index, const std::string& field,
               std::string text) {
  return {"part." + std::move(code), "/" + list + "/" + std::to_string(index) + "/" + field, std::move(text)};
}

template <class T>
Result<Done> unique_names(const std::vector<T>& items, const std::string& list) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!seen.insert(items[i].name).second)
      return issue_at("duplicate_name", list, i, "name", "\"" + items[i].name + "\" stands twice");
  return Done{};
}

template <class T>
Result<Done> known_joints(const PartDesc& part, const std::vector<T>& items, const std::string& list) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!items[i].joint.empty() && index_of(part, items[i].joint) < 0)
      return issue_at("unknown_joint", list, i, "joint", "\"" + items[i].joint + "\" is not a joint of this part");
  return Done{};
}

Result<Done> check_range(const JointDesc& joint, std::size_t i) {
  const bool travels = joint.type == JointType::prismatic;
  const double low = travels ? joint.low_m : joint.low_deg;
  const double high = travels ? joint.high_m : joint.high_deg;
  if (low <= 0.0 && high >= 0.0 && low < high) return Done{};
  return issue_at("bad_range", "joints", i, travels ? "low_m" : "low_deg",
                  "the range must hold the rest pose 0 and not be empty");
}

Result<Done> check_type(const JointDesc& joint, std::size_t i) {
  const JointDesc plain;
  const bool travels = joint.type == JointType::prismatic;
  const bool swings = joint.type == JointType::ball;
  if (!travels &&
      (joint.low_m != plain.low_m || joint.high_m != plain.high_m || joint.max_speed_m_s != plain.max_speed_m_s))
    return issue_at("other_type", "joints", i, "low_m", "only prismatic joints travel");
  if (travels && (joint.low_deg != plain.low_deg || joint.high_deg != plain.high_deg ||
                  joint.max_speed_deg_s != plain.max_speed_deg_s))
    return issue_at("other_type", "joints", i, "low_deg", "prismatic joints do not turn");
  if (!swings && (joint.swing_axis != plain.swing_axis || joint.swing_deg != plain.swing_deg ||
                  joint.swing_center_deg != plain.swing_center_deg))
    return issue_at("other_type", "joints", i, "swing_deg", "only ball joints swing");
  return Done{};
}

Result<Done> check_joint(const PartDesc& part, std::size_t i) {
  const JointDesc& joint = part.joints[i];
  const int parent = index_of(part, joint.parent);
  if (!joint.parent.empty() && (parent < 0 || parent >= static_cast<int>(i)))
    return issue_at("unknown_joint", "joints", i, "parent",
                    "\"" + joint.parent + "\" is not an earlier joint of this part");
  if (!is_unit(joint.axis)) return issue_at("bad_axis", "joints", i, "axis", "the axis must have length 1");
  if (const Result<Done> range = check_range(joint, i); !range) return range;
  if (const Result<Done> type = check_type(joint, i); !type) return type;
  const bool crossed = std::fabs(glm::dot(joint.axis, joint.swing_axis)) <= kUnitTolerance && is_unit(joint.swing_axis);
  if (joint.type == JointType::ball && !crossed)
    return issue_at("bad_axis", "joints", i, "swing_axis", "it must have length 1 and stand at a right angle to axis");
  return Done{};
}

bool hinge_triple(const PartDesc& part, std::size_t first) {
  if (first + 2 >= part.joints.size()) return false;
  const JointDesc* j = &part.joints[first];
  for (int i = 0; i < 3; ++i) {
    if (j[i].type != JointType::hinge || std::fabs(glm::dot(j[i].axis, j[(i + 1) % 3].axis)) > kUnitTolerance)
      return false;
    const bool on_the_spot = j[i].position_m == Vec3(0.0) && j[i].rotation_deg == Vec3(0.0);
    if (i > 0 && (j[i].parent != j[i - 1].name || !on_the_spot)) return false;
  }
  return true;
}

Result<Done> check_reach(const PartDesc& part) {
  for (const ReachDesc& reach : part.reach) {
    const int upper = index_of(part, reach.upper);
    const int middle = index_of(part, reach.middle);
    if (upper < 0)
      return issue_at("unknown_joint", "reach", 0, "upper", "\"" + reach.upper + "\" is not a joint of this part");
    if (middle < 0)
      return issue_at("unknown_joint", "reach", 0, "middle", "\"" + reach.middle + "\" is not a joint of this part");
    const auto u = static_cast<std::size_t>(upper);
    const bool ball = part.joints[u].type == JointType::ball;
    if (!ball && !hinge_triple(part, u))
      return issue_at("bad_reach", "reach", 0, "upper",
                      "it must be a ball joint or the first of three hinges in one point, with axes at right angles");
    const std::string& carrier = part.joints[ball ? u : u + 2].name;
    const JointDesc& m = part.joints[static_cast<std::size_t>(middle)];
    if (m.type != JointType::hinge || m.parent != carrier)
      return issue_at("bad_reach", "reach", 0, "middle", "it must be a hinge on \"" + carrier + "\"");
    if (!has_socket(part, reach.tip))
      return issue_at("unknown_socket", "reach", 0, "tip", "\"" + reach.tip + "\" is not a socket of this part");
    if (!moves_with(part, joint_of_socket(part, reach.tip), m.name))
      return issue_at("bad_reach", "reach", 0, "tip", "\"" + m.name + "\" does not move it");
  }
  return Done{};
}

Result<Done> check_facing(const PartDesc& part) {
  for (const FacingDesc& facing : part.facing) {
    for (const std::string& joint : facing.joints) {
      const int index = index_of(part, joint);
      if (index < 0)
        return issue_at("unknown_joint", "facing", 0, "joints", "\"" + joint + "\" is not a joint of this part");
      if (part.joints[static_cast<std::size_t>(index)].type == JointType::prismatic)
        return issue_at("bad_facing", "facing", 0, "joints", "\"" + joint + "\" does not turn");
    }
    for (std::size_t i = 0; i + 1 < facing.joints.size(); ++i)
      if (facing.joints[i] == facing.joints[i + 1] || !moves_with(part, facing.joints[i + 1], facing.joints[i]))
        return issue_at("bad_facing", "facing", 0, "joints", "each must move the next, from the body outward");
    if (facing.joints.empty()) return issue_at("bad_facing", "facing", 0, "joints", "at least one joint is needed");
    if (!has_socket(part, facing.socket))
      return issue_at("unknown_socket", "facing", 0, "socket", "\"" + facing.socket + "\" is not a socket of this part");
    if (!moves_with(part, joint_of_socket(part, facing.socket), facing.joints.back()))
      return issue_at("bad_facing", "facing", 0, "socket", "\"" + facing.joints.back() + "\" does not move it");
  }
  return Done{};
}

template <class T>
Result<Done> check_hulls(const std::vector<T>& items, const std::string& list) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto* hull = std::get_if<ConvexHull>(&items[i].shape);
    const std::string fault = hull == nullptr ? "" : hull_fault(hull->points_m);
    if (!fault.empty()) return issue_at("bad_shape", list, i, "shape/points_m", fault);
  }
  return Done{};
}

Result<Done> check_mesh(const std::vector<MeshDesc>& mesh) {
  if (const Result<Done> hulls = check_hulls(mesh, "mesh"); !hulls) return hulls;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const auto* triangles = std::get_if<TriangleMesh>(&mesh[i].shape);
    if (triangles == nullptr) continue;
    if (triangles->indices.size() % 3 != 0)
      return issue_at("bad_shape", "mesh", i, "shape/indices", "their number must be a multiple of 3");
    for (const int index : triangles->indices)
      if (index < 0 || index >= static_cast<int>(triangles->positions_m.size()))
        return issue_at("bad_shape", "mesh", i, "shape/indices", std::to_string(index) + " is no vertex");
  }
  return Done{};
}

}  // namespace

Result<Done> check_part(const PartDesc& part) {
  for (std::size_t i = 0; i < part.joints.size(); ++i)
    if (const Result<Done> joint = check_joint(part, i); !joint) return joint;
  for (const Result<Done>& rule :
       {unique_names(part.joints, "joints"), unique_names(part.colliders, "colliders"),
        unique_names(part.sockets, "sockets"), known_joints(part, part.colliders, "colliders"),
        known_joints(part, part.mesh, "mesh"), known_joints(part, part.sockets, "sockets"),
        check_hulls(part.colliders, "colliders"), check_mesh(part.mesh), check_reach(part), check_facing(part)})
    if (!rule) return rule;
  return Done{};
}

Result<Done> check_object(const ObjectDesc& object) {
  const PartDesc no_joints;
  for (Result<Done> rule :
       {unique_names(object.colliders, "colliders"), unique_names(object.points, "points"),
        known_joints(no_joints, object.colliders, "colliders"), known_joints(no_joints, object.mesh, "mesh"),
        known_joints(no_joints, object.points, "points"), check_hulls(object.colliders, "colliders"),
        check_mesh(object.mesh)})
    if (!rule) {
      Issue issue = rule.issue();
      issue.code.replace(0, std::string("part").size(), "object");
      return issue;
    }
  return Done{};
}

}  // namespace contort
