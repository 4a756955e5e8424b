// Maps nodes of a foreign skeleton to joints of a character, so that the character's limits apply to them.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

struct JointMap {
  std::map<std::string, std::string> joints;  // node of the file -> slot/joint of the character
  bool operator==(const JointMap&) const = default;
};

// Parses a file such as {"format": "contort.map/1", "joints": {"mixamorig:LeftForeArm": "arm_left/elbow"}}. Codes
// json.*, map.*.
Result<JointMap> parse_joint_map(std::string_view text);

std::string print_joint_map(const JointMap& map);

std::string joint_map_schema();

}  // namespace contort
