#include "formats/robot/mjcf_text.h"

#include <tinyxml2.h>

#include <cmath>
#include <set>

namespace contort {

namespace {

constexpr int kMaxIncludeDepth = 4;
constexpr std::size_t kMaxClasses = 1000;

// Replaces each <include file="..."/> by the children of that file's outermost element.
class Includer {
 public:
  explicit Includer(const ReadIncluded& read) : read_(read) {}

  Result<Done> expand(XmlElement& parent, int depth) {
    for (XmlElement* child = parent.FirstChildElement(); child != nullptr;) {
      XmlElement* next = child->NextSiblingElement();
      const bool is_include = std::string_view(child->Name()) == "include";
      const Result<Done> done = is_include ? insert(parent, *child, depth) : expand(*child, depth);
      if (!done) return done;
      child = next;
    }
    return Done{};
  }

 private:
  Result<Done> insert(XmlElement& parent, XmlElement& include, int depth) {
    const std::string file = attribute_of(include, "file");
    if (depth >= kMaxIncludeDepth)
      return Issue{"mjcf.bad_include", "", "files include each other deeper than " + std::to_string(kMaxIncludeDepth)};
    if (!seen_.insert(file).second) return Issue{"mjcf.bad_include", "", quoted_name(file) + " is included twice"};
    const Result<std::string> text = read_(file);
    if (!text) return Issue{"mjcf.bad_include", "", "<include> of " + quoted_name(file) + ": " + text.issue().text};
    bytes_ += text->size();
    if (bytes_ > kMaxRobotBytes) return Issue{"mjcf.too_large", "", "the included files are too large together"};
    const Result<XmlText> document = XmlText::parse(*text, "mjcf");
    if (!document) return Issue{document.issue().code, "", quoted_name(file) + ": " + document.issue().text};
    if (const Result<Done> inner = expand(document->root(), depth + 1); !inner) return inner;
    tinyxml2::XMLNode* after = &include;
    for (const XmlElement* child : elements_of(document->root()))
      after = parent.InsertAfterChild(after, child->DeepClone(parent.GetDocument()));
    parent.DeleteChild(&include);
    return Done{};
  }

  const ReadIncluded& read_;
  std::set<std::string> seen_;
  std::size_t bytes_ = 0;
};

bool is_actuator(const std::string& tag) {
  for (const char* kind : {"general", "motor", "position", "velocity", "intvelocity", "damper", "cylinder", "muscle",
                           "adhesion", "plugin"})
    if (tag == kind) return true;
  return false;
}

}  // namespace

std::string value_of(const MjcfAttributes& given, const std::string& attribute) {
  const auto found = given.find(attribute);
  return found == given.end() ? "" : found->second;
}

Result<XmlText> MjcfText::with_includes(std::string_view text, const ReadIncluded& read_included) {
  Result<XmlText> document = XmlText::parse(text, "mjcf");
  if (!document) return document;
  if (tag_of(document->root()) != "mujoco")
    return Issue{"mjcf.wrong_kind", "",
                 "the outermost element is <" + tag_of(document->root()) + ">, expected <mujoco>"};
  if (const Result<Done> done = Includer(read_included).expand(document->root(), 0); !done) return done.issue();
  return document;
}

void MjcfText::read_settings(const XmlElement& root) {
  for (const XmlElement* compiler : elements_of(root, "compiler")) {
    const MjcfAttributes given = attributes_of(*compiler);
    if (const std::string angle = value_of(given, "angle"); !angle.empty()) settings_.is_in_degrees = angle != "radian";
    if (const std::string limits = value_of(given, "autolimits"); !limits.empty())
      settings_.has_automatic_limits = limits != "false";
    if (const std::string order = value_of(given, "eulerseq"); !order.empty()) settings_.euler_order = order;
    for (const char* folder : {"assetdir", "meshdir"})
      if (const std::string name = value_of(given, folder); !name.empty()) settings_.mesh_folder = name;
    if (const std::string use = value_of(given, "inertiafromgeom"); !use.empty()) settings_.inertia_from_geom = use;
    if (value_of(given, "coordinate") == "global")
      faults.fail("bad_type", *compiler, "coordinate=\"global\" is not read; MuJoCo has dropped it too");
    settings_.least_mass_kg = number(*compiler, given, "boundmass", settings_.least_mass_kg);
    settings_.least_inertia_kg_m2 = number(*compiler, given, "boundinertia", settings_.least_inertia_kg_m2);
    settings_.total_mass_kg = number(*compiler, given, "settotalmass", settings_.total_mass_kg);
    if (const auto groups = numbers(*compiler, given, "inertiagrouprange", 2, 2))
      settings_.inertia_groups = {(*groups)[0], (*groups)[1]};
  }
}

void MjcfText::read_classes(const XmlElement& root) {
  classes_["main"];
  for (const XmlElement* outermost : elements_of(root, "default")) read_class(*outermost, "main", true);
}

void MjcfText::read_class(const XmlElement& element, const std::string& parent, bool is_outermost) {
  const std::string own = attribute_of(element, "class");
  const std::string name = is_outermost ? "main" : own;
  if (name.empty()) return faults.fail("unknown_class", element, "a default class needs a name");
  if (classes_.size() >= kMaxClasses) return faults.fail("too_large", element, "too many default classes");
  if (!is_outermost && classes_.contains(name))
    return faults.fail("duplicate_name", element, "a second class has the name " + quoted_name(name));
  auto values = classes_[parent];
  for (const XmlElement* child : elements_of(element)) {
    const std::string tag = tag_of(*child);
    if (tag == "default") continue;
    for (const auto& [attribute, value] : attributes_of(*child))
      values[is_actuator(tag) ? "actuator" : tag][attribute] = value;
  }
  classes_[name] = values;
  if (is_outermost && !own.empty()) classes_[own] = values;
  for (const XmlElement* child : elements_of(element, "default"))
    if (faults.ok()) read_class(*child, name, false);
}

MjcfAttributes MjcfText::attributes(const XmlElement& element, const std::string& childclass) {
  MjcfAttributes own = attributes_of(element);
  const std::string given = value_of(own, "class");
  const std::string name = given.empty() ? childclass : given;
  const auto found = classes_.find(name.empty() ? "main" : name);
  if (found == classes_.end()) {
    faults.fail("unknown_class", element, "there is no default class " + quoted_name(name));
    return own;
  }
  const std::string tag = tag_of(element);
  if (const auto values = found->second.find(is_actuator(tag) ? "actuator" : tag); values != found->second.end())
    own.insert(values->second.begin(), values->second.end());  // keeps the element's own values
  return own;
}

std::optional<std::vector<double>> MjcfText::numbers(const XmlElement& element, const MjcfAttributes& given,
                                                     const char* attribute, std::size_t least, std::size_t most) {
  const auto found = given.find(attribute);
  if (found == given.end()) return {};
  const std::optional<std::vector<double>> values = numbers_in(found->second, most);
  if (values && values->size() >= least) return values;
  faults.fail("bad_number", element,
              std::string(attribute) + " is " + quoted_name(found->second) + ", expected " + std::to_string(least) +
                  (least == most ? "" : " to " + std::to_string(most)) + " finite numbers");
  return {};
}

double MjcfText::number(const XmlElement& element, const MjcfAttributes& given, const char* attribute,
                        double otherwise) {
  const auto value = numbers(element, given, attribute, 1, 1);
  return value ? value->front() : otherwise;
}

Vec3 MjcfText::vector(const XmlElement& element, const MjcfAttributes& given, const char* attribute,
                      const Vec3& otherwise) {
  const auto v = numbers(element, given, attribute, 3, 3);
  return v ? Vec3((*v)[0], (*v)[1], (*v)[2]) : otherwise;
}

Quat MjcfText::turn_of_euler(const XmlElement& element, const std::vector<double>& angles) {
  Quat out = kNoRotation;
  const std::string& order = settings_.euler_order;
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = i < order.size() ? order[i] : '?';
    const std::size_t axis = std::string_view("xyzXYZ").find(letter);
    if (axis == std::string_view::npos || std::fabs(angles[i]) > 1e4) {
      faults.fail("bad_number", element, "the Euler angles or their order, " + quoted_name(order) + ", are not valid");
      return kNoRotation;
    }
    Vec3 unit(0.0);
    unit[static_cast<int>(axis % 3)] = 1.0;
    const Quat step = axis_angle(unit, to_rad(angles[i]));
    out = axis < 3 ? out * step : step * out;
  }
  return out;
}

Quat MjcfText::turn(const XmlElement& element, const MjcfAttributes& given) {
  if (const auto q = numbers(element, given, "quat", 4, 4)) {
    const Quat quat((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
    return glm::dot(quat, quat) > 1e-20 ? glm::normalize(quat) : kNoRotation;
  }
  if (const auto a = numbers(element, given, "axisangle", 4, 4)) {
    if (std::fabs((*a)[3]) > 1e6) faults.fail("bad_number", element, "an angle is too large");
    const Vec3 axis = unit_or(Vec3((*a)[0], (*a)[1], (*a)[2]), Vec3(0, 0, 1));
    return faults.ok() ? axis_angle(axis, to_rad((*a)[3])) : kNoRotation;
  }
  if (const auto angles = numbers(element, given, "euler", 3, 3)) return turn_of_euler(element, *angles);
  if (const auto a = numbers(element, given, "xyaxes", 6, 6)) {
    const Vec3 x = unit_or(Vec3((*a)[0], (*a)[1], (*a)[2]), Vec3(1, 0, 0));
    const Vec3 given_y((*a)[3], (*a)[4], (*a)[5]);
    const Vec3 y = unit_or(given_y - glm::dot(given_y, x) * x, perpendicular(x));
    return glm::normalize(glm::quat_cast(Mat3(x, y, glm::cross(x, y))));
  }
  if (const auto z = numbers(element, given, "zaxis", 3, 3))
    return shortest_arc(Vec3(0, 0, 1), unit_or(Vec3((*z)[0], (*z)[1], (*z)[2]), Vec3(0, 0, 1)));
  return kNoRotation;
}

Rigid MjcfText::pose(const XmlElement& element, const MjcfAttributes& given) {
  return {turn(element, given), vector(element, given, "pos", Vec3(0.0))};
}

}  // namespace contort
