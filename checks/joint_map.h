// Maps nodes of a foreign skeleton, and joints of a robot's file, to joints of a character, so that the character's
// limits apply to them.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "model/core/result.h"
#include "model/motion/file_joint.h"

namespace contort {

struct JointMap {
  std::map<std::string, std::string> joints;  // node of the file -> slot/joint of the character
  FileJoints values{};  // joints of a robot's file, for tables of their values
  std::array<double, 4> root_rotation{0.0, 0.0, 0.0, 1.0};  // x y z w, of the root's body in the robot's file at rest
  bool operator==(const JointMap&) const = default;
};

// Parses a file such as {"format": "contort.map/1", "joints": {"mixamorig:LeftForeArm": "arm_left/elbow"}}. Codes
// json.*, map.*.
Result<JointMap> parse_joint_map(std::string_view text);

std::string print_joint_map(const JointMap& map);

std::string joint_map_schema();

}  // namespace contort
