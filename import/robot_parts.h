// Cuts a robot's linkage into parts of a character.
#pragma once

#include "import/robot_linkage.h"
#include "model/core/result.h"

namespace contort {

// A collider's name in the character, with its shape's place in the linkage.
struct RobotCollider {
  std::string name;  // "arm_left/forearm"
  int link = 0;
  int shape = 0;
};

struct RobotParts {
  std::vector<PartDesc> parts;
  std::vector<SlotDesc> slots;
  std::vector<RobotCollider> colliders;
  std::vector<std::string> joint_of_link;  // "arm_left/elbow"; "root" for the first
};

// Also fills in the joints' names in the linkage's reports. Code import.too_many_parts.
Result<RobotParts> cut_robot(Linkage& linkage, const std::string& name, double strength_Nm);

}  // namespace contort
