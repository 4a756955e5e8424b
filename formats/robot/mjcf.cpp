#include "formats/robot/mjcf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "formats/robot/mjcf_geom.h"
#include "formats/robot/mjcf_text.h"
#include "formats/robot/shapes.h"
#include "model/core/index.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

constexpr const char* kWorld = "world";

class MjcfReader {
 public:
  Result<RobotModel> read(const XmlElement& root) {
    text_.read_settings(root);
    text_.read_classes(root);
    meshes_ = read_meshes(text_, root);
    all_.name = attribute_of(root, "model");
    all_.bodies.push_back({.name = kWorld});
    for (const XmlElement* world : elements_of(root, "worldbody")) read_children(*world, 0, Rigid{}, "");
    set_total_mass();
    read_actuators(root);
    read_contacts(root);
    read_couplings(root);
    if (text_.faults.ok() && all_.bodies.size() < 2) text_.faults.fail("bad_tree", root, "the worldbody has no body");
    if (!text_.faults.ok()) return text_.faults.issue();
    if (greatest_range_deg_ > 0.0 && greatest_range_deg_ < 2.0 * kPi)
      note(all_, "No range is larger than " + number_text(greatest_range_deg_) +
                     " degrees. If radians are meant, the file needs <compiler angle=\"radian\"/>.");
    return robot_of(main_tree());
  }

 private:
  bool ok() const { return text_.faults.ok(); }

  void read_children(const XmlElement& element, int body, const Rigid& body_from_frame, const std::string& childclass) {
    for (const XmlElement* child : elements_of(element)) {
      const std::string tag = tag_of(*child);
      if (!ok()) return;
      if (tag == "body") read_body(*child, body, body_from_frame, childclass);
      if (tag == "frame") read_frame(*child, body, body_from_frame, childclass);
      if (tag == "geom" && body > 0) add_geom(*child, body, body_from_frame, childclass);
      if (tag == "joint" || tag == "freejoint") add_joint(*child, body, body_from_frame, childclass);
      if (tag == "replicate" || tag == "composite" || tag == "flexcomp" || tag == "attach")
        note(all_, "Elements " + quoted_name(tag) + " are not read.");
    }
  }

  void read_frame(const XmlElement& element, int body, const Rigid& body_from_frame, const std::string& childclass) {
    const std::string own = attribute_of(element, "childclass");
    const Rigid frame = body_from_frame * text_.pose(element, attributes_of(element));
    read_children(element, body, frame, own.empty() ? childclass : own);
  }

  void read_body(const XmlElement& element, int parent, const Rigid& parent_from_frame, const std::string& childclass) {
    const std::string own_class = attribute_of(element, "childclass");
    const int index = static_cast<int>(all_.bodies.size());
    if (all_.bodies.size() >= kMaxRobotBodies)
      return text_.faults.fail("too_large", element, "more than " + std::to_string(kMaxRobotBodies) + " bodies");
    RobotBody body;
    body.name = attribute_of(element, "name");
    if (body.name.empty()) body.name = "body_" + std::to_string(index);
    if (!names_.insert(body.name).second)
      return text_.faults.fail("duplicate_name", element, "a second body has the name " + quoted_name(body.name));
    if (attribute_of(element, "mocap") == "true") return note(all_, "The mocap body " + body.name + " is left out.");
    body.parent = parent;
    body.parent_from_body = parent_from_frame * text_.pose(element, attributes_of(element));
    all_.bodies.push_back(std::move(body));
    read_children(element, index, Rigid{}, own_class.empty() ? childclass : own_class);
    if (ok()) set_inertia(element, index);
  }

  void set_inertia(const XmlElement& element, int index) {
    BodyInertia& inertia = all_.bodies[at(index)].inertia;
    const std::string& use = text_.settings().inertia_from_geom;
    const XmlElement* given = element_of(element, "inertial");
    if (use == "false" || (use == "auto" && given != nullptr))
      inertia = given == nullptr ? BodyInertia{} : read_inertial(text_, *given);
    else if (unknown_mass_.contains(index))
      note(all_, "Body " + quoted_name(all_.bodies[at(index)].name) +
                     " has its mass from a mesh, which is not weighed: that mass is missing.");
    inertia.mass_kg = std::max(inertia.mass_kg, text_.settings().least_mass_kg);
    for (int i = 0; i < 3; ++i)
      inertia.inertia_kg_m2[i][i] = std::max(inertia.inertia_kg_m2[i][i], text_.settings().least_inertia_kg_m2);
  }

  void add_geom(const XmlElement& element, int body, const Rigid& body_from_frame, const std::string& childclass) {
    if (++geoms_ > kMaxRobotItems)
      return text_.faults.fail("too_large", element, "more than " + std::to_string(kMaxRobotItems) + " geoms");
    MjcfGeom geom = read_geom(text_, element, text_.attributes(element, childclass), meshes_);
    RobotBody& owner = all_.bodies[at(body)];
    if (geom.has_unknown_mass) unknown_mass_.insert(body);
    if (!geom.left_out.empty())
      note(all_,
           "A shape of body " + quoted_name(owner.name) + " of type " + quoted_name(geom.left_out) + " is left out.");
    owner.inertia = merged(owner.inertia, moved(body_from_frame, geom.inertia));
    if (!geom.shape) return;
    geom.shape->shape = moved_shape(body_from_frame, geom.shape->shape);
    geom.shape->body_from_mesh = body_from_frame * geom.shape->body_from_mesh;
    owner.shapes.push_back(std::move(*geom.shape));
  }

  void add_joint(const XmlElement& element, int body, const Rigid& body_from_frame, const std::string& childclass) {
    if (body == 0) return text_.faults.fail("bad_tree", element, "the world has no joints");
    const bool is_free_tag = tag_of(element) == "freejoint";
    const MjcfAttributes given = is_free_tag ? attributes_of(element) : text_.attributes(element, childclass);
    const std::string type = is_free_tag ? "free" : value_of(given, "type");
    RobotBody& owner = all_.bodies[at(body)];
    RobotJoint joint;
    joint.name = attribute_of(element, "name");
    if (joint.name.empty()) joint.name = owner.name + "_joint_" + std::to_string(owner.joints.size() + 1);
    if (!joint_names_.insert(joint.name).second)
      return text_.faults.fail("duplicate_name", element, "a second joint has the name " + quoted_name(joint.name));
    if (joint_names_.size() > kMaxRobotItems)
      return text_.faults.fail("too_large", element, "more than " + std::to_string(kMaxRobotItems) + " joints");
    if (type == "free") {
      if (owner.parent != 0) return text_.faults.fail("bad_tree", element, "only a body of the world may be free");
      free_.insert(body);
      return;
    }
    if (type == "ball")
      joint.kind = RobotJointKind::ball;
    else if (type == "slide")
      joint.kind = RobotJointKind::travel;
    else if (!type.empty() && type != "hinge")
      return text_.faults.fail("bad_type", element,
                               "found the type " + quoted_name(type) + ", allowed are free, ball, slide and hinge");
    read_motion(element, given, body_from_frame, joint);
    owner.joints.push_back(std::move(joint));
  }

  void read_motion(const XmlElement& element, const MjcfAttributes& given, const Rigid& body_from_frame,
                   RobotJoint& joint) {
    joint.anchor_m = body_from_frame * text_.vector(element, given, "pos", Vec3(0.0));
    const Vec3 axis = unit_or(text_.vector(element, given, "axis", Vec3(0, 0, 1)), Vec3(0.0));
    if (ok() && length(axis) < 0.5)
      return text_.faults.fail("bad_axis", element, "the axis of joint " + quoted_name(joint.name) + " has no length");
    joint.axis = joint.kind == RobotJointKind::ball ? Vec3(0, 0, 1) : body_from_frame.q * axis;
    const bool turns = joint.kind != RobotJointKind::travel;
    const auto in_units = [&](double value) { return turns ? text_.to_rad(value) : value; };
    joint.at_rest = in_units(text_.number(element, given, "ref", 0.0));
    const std::string limited = value_of(given, "limited");
    const auto range = text_.numbers(element, given, "range", 2, 2);
    if (range && (limited == "true" || (limited != "false" && text_.settings().has_automatic_limits))) {
      joint.low = in_units((*range)[0]), joint.high = in_units((*range)[1]);
      if (turns && text_.settings().is_in_degrees)
        greatest_range_deg_ = std::max({greatest_range_deg_, std::fabs((*range)[0]), std::fabs((*range)[1])});
      if (joint.low > joint.high)
        text_.faults.fail("bad_limit", element, "the range of joint " + quoted_name(joint.name) + " is turned around");
    } else if (range && limited != "false") {
      note(all_, "Joint " + quoted_name(joint.name) + " has a range that autolimits=\"false\" switches off.");
    }
    if (const auto force = text_.numbers(element, given, "actuatorfrcrange", 2, 2))
      joint.greatest_effort = std::max(std::fabs((*force)[0]), std::fabs((*force)[1]));
  }

  void set_total_mass() {
    const double wanted_kg = text_.settings().total_mass_kg;
    double sum_kg = 0.0;
    for (const RobotBody& body : all_.bodies) sum_kg += body.inertia.mass_kg;
    if (!(wanted_kg > 0.0) || !(sum_kg > 0.0)) return;
    for (RobotBody& body : all_.bodies) {
      body.inertia.mass_kg *= wanted_kg / sum_kg;
      body.inertia.inertia_kg_m2 *= wanted_kg / sum_kg;
    }
  }

  // The effort of a joint is its actuator's force times its gear.
  void read_actuators(const XmlElement& root) {
    std::map<std::string, RobotJoint*> joints;
    for (RobotBody& body : all_.bodies)
      for (RobotJoint& joint : body.joints) joints[joint.name] = &joint;
    for (const XmlElement* list : elements_of(root, "actuator"))
      for (const XmlElement* actuator : elements_of(*list)) {
        const MjcfAttributes given = text_.attributes(*actuator, "");
        const auto joint = joints.find(value_of(given, "joint"));
        const auto gear = text_.numbers(*actuator, given, "gear", 1, 6);
        const auto force = text_.numbers(*actuator, given, "forcerange", 2, 2);
        const auto control = text_.numbers(*actuator, given, "ctrlrange", 2, 2);
        const bool is_motor = tag_of(*actuator) == "motor";
        const auto& range = force ? force : is_motor ? control : std::optional<std::vector<double>>{};
        if (joint == joints.end() || !range || joint->second->greatest_effort > 0.0) continue;
        const double greatest = std::max(std::fabs((*range)[0]), std::fabs((*range)[1]));
        joint->second->greatest_effort = greatest * std::fabs(gear ? gear->front() : 1.0);
      }
  }

  void read_contacts(const XmlElement& root) {
    for (const XmlElement* list : elements_of(root, "contact"))
      for (const XmlElement* exclude : elements_of(*list, "exclude")) {
        const std::string a = attribute_of(*exclude, "body1"), b = attribute_of(*exclude, "body2");
        if (all_.may_touch.size() >= kMaxRobotItems)
          return text_.faults.fail("too_large", *exclude, "more than " + std::to_string(kMaxRobotItems) + " pairs");
        for (const std::string& name : {a, b})
          if (!names_.contains(name) && name != kWorld)
            note(all_, "The file excludes contacts of " + quoted_name(name) + ", which is no body.");
        all_.may_touch.push_back({a, b, "MJCF: exclude"});
      }
  }

  // A joint that an equality couples to another one follows it, as in URDF's mimic, if the polynomial is linear.
  void read_couplings(const XmlElement& root) {
    std::map<std::string, RobotJoint*> joints;
    for (RobotBody& body : all_.bodies)
      for (RobotJoint& joint : body.joints) joints[joint.name] = &joint;
    for (const XmlElement* list : elements_of(root, "equality"))
      for (const XmlElement* equality : elements_of(*list)) {
        const MjcfAttributes given = text_.attributes(*equality, "");
        if (value_of(given, "active") == "false") continue;
        const auto joint = joints.find(value_of(given, "joint1"));
        if (tag_of(*equality) != "joint" || joint == joints.end() || value_of(given, "joint2").empty()) {
          note(all_, "The equality " + quoted_name(tag_of(*equality)) + " of " +
                         quoted_name(value_of(given, "body1") + value_of(given, "joint1") + value_of(given, "site1")) +
                         " cannot be expressed: a character is a tree, and the loop is open.");
          continue;
        }
        const auto line = text_.numbers(*equality, given, "polycoef", 2, 5);
        joint->second->follows = value_of(given, "joint2");
        joint->second->offset = line ? (*line)[0] : 0.0;
        joint->second->multiplier = line ? (*line)[1] : 1.0;
      }
    if (element_of(root, "tendon") != nullptr) note(all_, "Tendons are not read.");
  }

  int top_of(int body) const {
    while (all_.bodies[at(body)].parent > 0) body = all_.bodies[at(body)].parent;
    return body;
  }

  // The body of the world with most joints below it; objects of the scene have few.
  int main_tree() {
    std::map<int, int> joints;
    for (int i = 1; i < static_cast<int>(all_.bodies.size()); ++i)
      joints[top_of(i)] += static_cast<int>(all_.bodies[at(i)].joints.size());
    int best = 1;
    for (const auto& [top, count] : joints)
      if (count > joints[best]) best = top;
    for (const auto& [top, count] : joints)
      if (top != best) note(all_, "Body " + quoted_name(all_.bodies[at(top)].name) + " of the scene is left out.");
    return best;
  }

  // Returns true if the joints place the root, as in planar robots: one of them is a travel without limits.
  bool places_root(const RobotBody& top) const {
    return std::any_of(top.joints.begin(), top.joints.end(), [](const RobotJoint& joint) {
      return joint.kind == RobotJointKind::travel && joint.low == -kNoLimit && joint.high == kNoLimit;
    });
  }

  RobotModel robot_of(int top) {
    RobotModel out = all_;
    out.bodies.clear();
    RobotBody first = all_.bodies[at(top)];
    out.has_free_root = free_.contains(top) || places_root(first);
    if (places_root(first)) {
      note(out, "The " + std::to_string(first.joints.size()) + " joints of body " + quoted_name(first.name) +
                    " place the root, which moves freely here.");
      first.joints.clear();
    }
    std::vector<int> index(all_.bodies.size(), -1);
    if (!first.joints.empty()) out.bodies.push_back({.name = kWorld}), index[0] = 0;
    for (std::size_t i = at(top); i < all_.bodies.size(); ++i) {
      RobotBody body = static_cast<int>(i) == top ? first : all_.bodies[i];
      if (static_cast<int>(i) != top && top_of(static_cast<int>(i)) != top) continue;
      body.parent = index[at(body.parent)];
      index[i] = static_cast<int>(out.bodies.size());
      out.bodies.push_back(std::move(body));
    }
    return out;
  }

  MjcfText text_;
  MjcfMeshes meshes_;
  RobotModel all_;  // the world is the first body
  std::set<std::string> names_;
  std::set<std::string> joint_names_;
  std::set<int> free_;
  std::set<int> unknown_mass_;
  std::size_t geoms_ = 0;
  double greatest_range_deg_ = 0.0;
};

}  // namespace

Result<RobotModel> parse_mjcf(std::string_view text, const ReadIncluded& read_included) {
  const Result<XmlText> document = MjcfText::with_includes(text, read_included);
  if (!document) return document.issue();
  return MjcfReader().read(document->root());
}

}  // namespace contort
