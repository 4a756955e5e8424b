// A joint of the robot's file that a character was made from. It converts values of the file's joints to coordinates of
// the character.
#pragma once

#include <map>
#include <string>

namespace contort {

struct FileJoint {
  std::string joint{};       // name of the character's joint, "arm/elbow"; "" if it is fixed in the character
  double at_rest = 0.0;      // the file's value in the character's rest pose, where the coordinate is 0; rad or m
  std::string follows{};     // name of the file's joint that it follows (URDF's mimic); "" for none
  double multiplier = 1.0;   // factor for the value of that joint
  double offset = 0.0;       // rad or m; added to the product
  bool operator==(const FileJoint&) const = default;
};

using FileJoints = std::map<std::string, FileJoint>;  // by the file's names

}  // namespace contort
