#include "formats/robot/urdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "formats/robot/shapes.h"
#include "formats/robot/xml.h"
#include "model/core/index.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

// A joint as written in its element, with the index of the link that it moves.
struct UrdfJoint {
  std::string name;
  std::string type;
  int parent = -1;
  int child = -1;
  Rigid parent_from_child;
  RobotJoint motion;
  int line = 0;
};

// Roll, pitch and yaw turn about the fixed axes X, Y and Z, one after another.
Quat turn_of_rpy(const Vec3& rpy) {
  return axis_angle(Vec3(0, 0, 1), rpy.z) * axis_angle(Vec3(0, 1, 0), rpy.y) * axis_angle(Vec3(1, 0, 0), rpy.x);
}

class UrdfReader {
 public:
  Result<RobotModel> read(const XmlElement& root) {
    robot_.name = attribute_of(root, "name");
    for (const XmlElement* link : elements_of(root, "link")) add_link(*link);
    for (const XmlElement* joint : elements_of(root, "joint")) add_joint(*joint);
    if (faults_.ok() && robot_.bodies.empty()) faults_.fail("bad_tree", root, "the robot has no link");
    if (faults_.ok()) check_parents(root);
    if (!faults_.ok()) return faults_.issue();
    note_all(robot_, "Their soft limits (safety_controller) are not taken over", with_soft_limits_);
    note_all(robot_, "Their axes did not have length 1 and were brought to it", with_long_axes_);
    note_all(robot_, "They are revolute or prismatic but give no lower or upper limit", without_range_);
    return ordered();
  }

 private:
  double number(const XmlElement& element, const char* attribute, double otherwise) {
    if (!has_attribute(element, attribute)) return otherwise;
    const std::optional<std::vector<double>> value = numbers_in(attribute_of(element, attribute), 1);
    if (value && value->size() == 1) return value->front();
    faults_.fail(
        "bad_number", element,
        std::string(attribute) + " is " + quoted_name(attribute_of(element, attribute)) + ", expected a finite number");
    return otherwise;
  }

  Vec3 vector(const XmlElement& element, const char* attribute, const Vec3& otherwise) {
    if (!has_attribute(element, attribute)) return otherwise;
    const std::optional<std::vector<double>> value = numbers_in(attribute_of(element, attribute), 3);
    if (value && value->size() == 3) return {(*value)[0], (*value)[1], (*value)[2]};
    faults_.fail("bad_number", element,
                 std::string(attribute) + " is " + quoted_name(attribute_of(element, attribute)) +
                     ", expected three finite numbers");
    return otherwise;
  }

  Rigid origin(const XmlElement& element) {
    const XmlElement* at = element_of(element, "origin");
    if (at == nullptr) return {};
    const Vec3 rpy = vector(*at, "rpy", Vec3(0.0));
    for (int i = 0; i < 3; ++i)
      if (std::fabs(rpy[i]) > 1e4) faults_.fail("bad_number", *at, "an angle is larger than 10000 rad");
    return faults_.ok() ? Rigid{turn_of_rpy(rpy), vector(*at, "xyz", Vec3(0.0))} : Rigid{};
  }

  void add_link(const XmlElement& element) {
    if (!faults_.ok()) return;
    RobotBody body;
    body.name = attribute_of(element, "name");
    if (body.name.empty()) return faults_.fail("no_name", element, "a link needs a name");
    if (!link_index_.emplace(body.name, static_cast<int>(robot_.bodies.size())).second)
      return faults_.fail("duplicate_name", element, "a second link has the name " + quoted_name(body.name));
    if (robot_.bodies.size() >= kMaxRobotBodies)
      return faults_.fail("too_large", element, "more than " + std::to_string(kMaxRobotBodies) + " links");
    if (const XmlElement* inertial = element_of(element, "inertial")) body.inertia = inertia(*inertial);
    for (const XmlElement* collision : elements_of(element, "collision")) add_shape(*collision, body);
    robot_.bodies.push_back(std::move(body));
  }

  BodyInertia inertia(const XmlElement& element) {
    const Rigid at = origin(element);
    const XmlElement* mass = element_of(element, "mass");
    const XmlElement* tensor = element_of(element, "inertia");
    BodyInertia out;
    out.mass_kg = mass == nullptr ? 0.0 : number(*mass, "value", 0.0);
    if (out.mass_kg < 0.0) faults_.fail("bad_mass", *mass, "a mass is negative");
    if (tensor != nullptr) {
      constexpr std::array<const char*, 6> kNames = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};
      std::array<double, 6> i{};
      for (std::size_t k = 0; k < 6; ++k) i[k] = number(*tensor, kNames[k], 0.0);
      out.inertia_kg_m2 = Mat3(i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2]);
    }
    return out.mass_kg > 0.0 ? moved(at, out) : BodyInertia{};
  }

  void add_shape(const XmlElement& collision, RobotBody& body) {
    const XmlElement* geometry = element_of(collision, "geometry");
    const XmlElement* shape = geometry == nullptr ? nullptr : element_of(*geometry, nullptr);
    if (shape == nullptr) return;
    if (++shapes_ > kMaxRobotItems)
      return faults_.fail("too_large", *shape, "more than " + std::to_string(kMaxRobotItems) + " shapes");
    const Rigid at = origin(collision);
    RobotShape out;
    const std::string tag = tag_of(*shape);
    const double radius = number(*shape, "radius", 0.0), length = number(*shape, "length", 0.0);
    if (tag == "box") {
      out.shape = placed_box(at, 0.5 * vector(*shape, "size", Vec3(0.0)));
    } else if (tag == "sphere") {
      out.shape = Sphere{at.p_m, radius};
    } else if (tag == "capsule") {
      out.shape = placed_capsule(at, radius, 0.5 * length);
    } else if (tag == "cylinder") {
      out.shape = placed_cylinder(at, radius, 0.5 * length);
    } else if (tag == "mesh") {
      out.mesh = attribute_of(*shape, "filename");
      out.body_from_mesh = at;
      out.mesh_scale = vector(*shape, "scale", Vec3(1.0));
    } else {
      return note(robot_,
                  "The collision shape " + quoted_name(tag) + " of link " + quoted_name(body.name) + " is left out.");
    }
    if (out.mesh.empty() && !is_solid(out.shape))
      return note(robot_, "A collision shape of link " + quoted_name(body.name) + " has no size and is left out.");
    if (faults_.ok()) body.shapes.push_back(std::move(out));
  }

  int link_of(const XmlElement& joint, const char* which) {
    const XmlElement* element = element_of(joint, which);
    const std::string name = element == nullptr ? "" : attribute_of(*element, "link");
    const auto found = link_index_.find(name);
    if (found != link_index_.end()) return found->second;
    faults_.fail("unknown_link", joint,
                 std::string("its ") + which + " is " + quoted_name(name) + ", which is no link of the file");
    return 0;
  }

  void add_joint(const XmlElement& element) {
    if (!faults_.ok()) return;
    UrdfJoint joint;
    joint.name = joint.motion.name = attribute_of(element, "name");
    joint.type = attribute_of(element, "type");
    if (joint.name.empty()) return faults_.fail("no_name", element, "a joint needs a name");
    if (!joint_names_.insert(joint.name).second)
      return faults_.fail("duplicate_name", element, "a second joint has the name " + quoted_name(joint.name));
    joint.parent = link_of(element, "parent");
    joint.child = link_of(element, "child");
    joint.parent_from_child = origin(element);
    if (!faults_.ok()) return;
    for (const UrdfJoint& other : joints_)
      if (other.child == joint.child)
        return faults_.fail("bad_tree", element,
                            "link " + quoted_name(robot_.bodies[at(joint.child)].name) + " has two parents: joints " +
                                quoted_name(other.name) + " and " + quoted_name(joint.name));
    read_motion(element, joint);
    if (element_of(element, "safety_controller") != nullptr) with_soft_limits_.push_back(joint.name);
    joints_.push_back(std::move(joint));
  }

  void read_motion(const XmlElement& element, UrdfJoint& joint) {
    constexpr std::array kTypes = {"revolute", "continuous", "prismatic", "fixed", "floating", "planar"};
    bool is_known = false;
    for (const char* type : kTypes) is_known = is_known || joint.type == type;
    if (!is_known)
      return faults_.fail("bad_type", element,
                          "joint " + quoted_name(joint.name) + " has the type " + quoted_name(joint.type) +
                              ", allowed are revolute, continuous, " + "prismatic, fixed, floating and planar");
    if (joint.type == "fixed" || joint.type == "floating") return;
    joint.motion.kind = joint.type == "prismatic" ? RobotJointKind::travel : RobotJointKind::hinge;
    read_axis(element, joint);
    read_limit(element, joint);
    if (const XmlElement* mimic = element_of(element, "mimic")) {
      joint.motion.follows = attribute_of(*mimic, "joint");
      joint.motion.multiplier = number(*mimic, "multiplier", 1.0);
      joint.motion.offset = number(*mimic, "offset", 0.0);
    }
  }

  void read_axis(const XmlElement& element, UrdfJoint& joint) {
    const XmlElement* axis = element_of(element, "axis");
    const Vec3 given = axis == nullptr ? Vec3(1, 0, 0) : vector(*axis, "xyz", Vec3(1, 0, 0));
    joint.motion.axis = unit_or(given, Vec3(0.0));
    if (faults_.ok() && length(joint.motion.axis) < 0.5)
      return faults_.fail("bad_axis", element, "the axis of joint " + quoted_name(joint.name) + " has no length");
    if (std::fabs(length(given) - 1.0) > 1e-3) with_long_axes_.push_back(joint.name);
  }

  void read_limit(const XmlElement& element, UrdfJoint& joint) {
    const XmlElement* limit = element_of(element, "limit");
    RobotJoint& motion = joint.motion;
    const bool has_range = joint.type == "revolute" || joint.type == "prismatic";
    const bool gives_range = limit != nullptr && (has_attribute(*limit, "lower") || has_attribute(*limit, "upper"));
    if (has_range && gives_range) {
      motion.low = number(*limit, "lower", 0.0);
      motion.high = number(*limit, "upper", 0.0);
      if (motion.low > motion.high)
        faults_.fail("bad_limit", element,
                     "the lower limit of joint " + quoted_name(joint.name) + ", " + number_text(motion.low) +
                         ", is above the upper one, " + number_text(motion.high));
    } else if (has_range) {
      without_range_.push_back(joint.name);
    }
    if (limit == nullptr) return;
    motion.greatest_speed = number(*limit, "velocity", 0.0);
    motion.greatest_effort = number(*limit, "effort", 0.0);
    for (const double value : {motion.greatest_speed, motion.greatest_effort})
      if (value < 0.0) faults_.fail("bad_limit", *limit, "a velocity or an effort is negative");
  }

  void check_parents(const XmlElement& root) {
    std::vector<char> has_parent(robot_.bodies.size(), 0);
    for (const UrdfJoint& joint : joints_) has_parent[at(joint.child)] = 1;
    std::vector<std::string> roots;
    for (std::size_t i = 0; i < has_parent.size(); ++i)
      if (has_parent[i] == 0) roots.push_back(robot_.bodies[i].name), root_ = static_cast<int>(i);
    if (roots.empty()) return faults_.fail("bad_tree", root, "every link has a parent: the joints form a ring");
    if (roots.size() > 1)
      faults_.fail(
          "bad_tree", root,
          "links " + quoted_name(roots[0]) + " and " + quoted_name(roots[1]) + " have no parent; a robot has one root");
  }

  // Orders links, parents first, without recursion. Links that the root does not reach form a ring.
  Result<RobotModel> ordered() {
    std::vector<std::vector<std::size_t>> below(robot_.bodies.size());
    for (std::size_t j = 0; j < joints_.size(); ++j) below[at(joints_[j].parent)].push_back(j);
    RobotModel out = robot_;
    out.bodies.clear();
    std::vector<std::pair<std::size_t, int>> open;  // joint, index of its parent in `out`
    const auto add = [&](int link, RobotBody body) {
      out.bodies.push_back(std::move(body));
      for (auto j = below[at(link)].rbegin(); j != below[at(link)].rend(); ++j)
        open.emplace_back(*j, static_cast<int>(out.bodies.size()) - 1);
    };
    add(root_, robot_.bodies[at(root_)]);
    while (!open.empty()) {
      const auto [j, parent] = open.back();
      open.pop_back();
      add(joints_[j].child, attached(joints_[j], parent, out));
    }
    if (out.bodies.size() != robot_.bodies.size())
      return Issue{"urdf.bad_tree", "",
                   std::to_string(robot_.bodies.size() - out.bodies.size()) +
                       " links are not below the root: the joints form a ring"};
    return out;
  }

  RobotBody attached(const UrdfJoint& joint, int parent, RobotModel& out) const {
    RobotBody body = robot_.bodies[at(joint.child)];
    body.parent = parent;
    body.parent_from_body = joint.parent_from_child;
    if (joint.type == "fixed") return body;
    if (joint.type == "floating" || joint.type == "planar") {
      const RobotBody& carrier = out.bodies[at(parent)];
      if (parent == 0 && carrier.inertia.mass_kg <= 0.0 && carrier.shapes.empty()) {
        out.has_free_root = true;
        if (joint.type == "planar")
          note(out,
               "The planar joint " + quoted_name(joint.name) + " of the root is not checked: the root moves freely.");
        return body;
      }
      add_free_joints(joint, body);
      return body;
    }
    body.joints.push_back(joint.motion);
    return body;
  }

  // Adds a floating or planar joint inside the tree: travels, and a ball or a hinge.
  static void add_free_joints(const UrdfJoint& joint, RobotBody& body) {
    const Vec3 normal = joint.motion.axis, first = perpendicular(normal);
    const bool is_planar = joint.type == "planar";
    std::vector<Vec3> ways = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    if (is_planar) ways = {first, glm::cross(normal, first)};
    for (std::size_t i = 0; i < ways.size(); ++i)
      body.joints.push_back(
          {.name = joint.name + "_travel_" + std::to_string(i + 1), .kind = RobotJointKind::travel, .axis = ways[i]});
    body.joints.push_back({.name = joint.name,
                           .kind = is_planar ? RobotJointKind::hinge : RobotJointKind::ball,
                           .axis = is_planar ? normal : Vec3(0, 0, 1)});
  }

  XmlFaults faults_{"urdf"};
  RobotModel robot_;
  std::map<std::string, int> link_index_;
  std::set<std::string> joint_names_;
  std::vector<UrdfJoint> joints_;
  std::vector<std::string> with_soft_limits_;
  std::vector<std::string> with_long_axes_;
  std::vector<std::string> without_range_;
  std::size_t shapes_ = 0;
  int root_ = 0;
};

// xacro is a macro language that produces URDF. It has its own elements, and values such as "${width / 2}".
bool is_xacro(const XmlElement& root) {
  std::vector<const XmlElement*> open = {&root};
  while (!open.empty()) {
    const XmlElement& element = *open.back();
    open.pop_back();
    if (tag_of(element).starts_with("xacro:")) return true;
    for (const auto& [name, value] : attributes_of(element))
      if (value.find("${") != std::string::npos || value.starts_with("$(")) return true;
    for (const XmlElement* child : elements_of(element)) open.push_back(child);
  }
  return false;
}

Result<XmlText> parse_robot_element(std::string_view text, const std::string& area) {
  Result<XmlText> document = XmlText::parse(text, area);
  if (!document) return document;
  if (is_xacro(document->root()))
    return Issue{area + ".xacro", "",
                 "this is a xacro file, which must be expanded first: `xacro FILE.xacro > FILE." + area + "`"};
  if (tag_of(document->root()) != "robot")
    return Issue{area + ".wrong_kind", "",
                 "the outermost element is <" + tag_of(document->root()) + ">, expected <robot>"};
  return document;
}

}  // namespace

Result<RobotModel> parse_urdf(std::string_view text) {
  const Result<XmlText> document = parse_robot_element(text, "urdf");
  if (!document) return document.issue();
  return UrdfReader().read(document->root());
}

Result<Done> add_srdf(std::string_view text, RobotModel& robot) {
  const Result<XmlText> document = parse_robot_element(text, "srdf");
  if (!document) return document.issue();
  std::set<std::string> links;
  for (const RobotBody& body : robot.bodies) links.insert(body.name);
  std::set<std::pair<std::string, std::string>> seen;
  for (const XmlElement* pair : elements_of(document->root(), "disable_collisions")) {
    std::string a = attribute_of(*pair, "link1"), b = attribute_of(*pair, "link2");
    for (const std::string& link : {a, b})
      if (!links.contains(link))
        note(robot, "The SRDF lets " + quoted_name(a) + " and " + quoted_name(b) + " touch, but " + quoted_name(link) +
                        " is no link.");
    if (!links.contains(a) || !links.contains(b) || !seen.insert({std::min(a, b), std::max(a, b)}).second) continue;
    if (robot.may_touch.size() >= kMaxRobotItems)
      return Issue{"srdf.too_large", "", "more than " + std::to_string(kMaxRobotItems) + " pairs"};
    robot.may_touch.push_back({a, b, "SRDF: " + attribute_of(*pair, "reason")});
  }
  return Done{};
}

Result<std::string> robot_of_srdf(std::string_view text) {
  const Result<XmlText> document = parse_robot_element(text, "srdf");
  if (!document) return document.issue();
  return attribute_of(document->root(), "name");
}

}  // namespace contort
