// The general rules of MJCF: included files, default classes, the compiler's settings, and the forms of a pose.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/robot/mjcf.h"
#include "formats/robot/xml.h"

namespace contort {

using MjcfAttributes = std::map<std::string, std::string>;

// The settings of <compiler>; later ones replace earlier ones.
struct MjcfSettings {
  bool is_in_degrees = true;
  bool has_automatic_limits = true;
  std::string euler_order = "xyz";  // lower case: about the turned axes; upper case: about the fixed ones
  std::string mesh_folder;
  std::string inertia_from_geom = "auto";
  double least_mass_kg = 0.0;
  double least_inertia_kg_m2 = 0.0;
  double total_mass_kg = -1.0;  // above 0: the masses are scaled to this sum
  std::array<double, 2> inertia_groups = {0, 5};
};

// Reads attributes with the defaults of classes, and numbers with faults.
class MjcfText {
 public:
  // Replaces <include> by the included files. Codes mjcf.bad_include and those of XmlText::parse.
  static Result<XmlText> with_includes(std::string_view text, const ReadIncluded& read_included);

  void read_settings(const XmlElement& root);
  void read_classes(const XmlElement& root);
  const MjcfSettings& settings() const { return settings_; }

  // Returns the element's attributes, completed from its class, which is its own or `childclass`. All kinds of
  // actuators share their defaults.
  MjcfAttributes attributes(const XmlElement& element, const std::string& childclass);

  // The number of values must be between `least` and `most`; nothing if the attribute is missing or at fault.
  std::optional<std::vector<double>> numbers(const XmlElement& element, const MjcfAttributes& given,
                                             const char* attribute, std::size_t least, std::size_t most);
  double number(const XmlElement& element, const MjcfAttributes& given, const char* attribute, double otherwise);
  Vec3 vector(const XmlElement& element, const MjcfAttributes& given, const char* attribute, const Vec3& otherwise);

  // Reads pos, and one of quat, axisangle, euler, xyaxes and zaxis.
  Rigid pose(const XmlElement& element, const MjcfAttributes& given);
  double to_rad(double angle) const { return settings_.is_in_degrees ? angle * kRadPerDeg : angle; }

  XmlFaults faults{"mjcf"};

 private:
  void read_class(const XmlElement& element, const std::string& parent, bool is_outermost);
  Quat turn(const XmlElement& element, const MjcfAttributes& given);
  Quat turn_of_euler(const XmlElement& element, const std::vector<double>& angles);

  MjcfSettings settings_;
  std::map<std::string, std::map<std::string, MjcfAttributes>> classes_;  // by class, by tag
};

// Returns an attribute; "" if there is none.
std::string value_of(const MjcfAttributes& given, const std::string& attribute);

}  // namespace contort
