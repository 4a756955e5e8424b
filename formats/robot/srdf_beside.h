// Finds the SRDF of a robot in the places where packages of ROS and MoveIt keep it beside the URDF.
#pragma once

#include <string>
#include <vector>

#include "model/core/result.h"

namespace contort {

// An SRDF that cannot be read, with the reason.
struct UnreadableSrdf {
  std::string file;
  Issue issue;
  bool operator==(const UnreadableSrdf&) const = default;
};

// The found files. Files with equal text count once.
struct SrdfsBeside {
  std::vector<std::string> fitting;         // files about a robot with the URDF's name
  std::vector<std::string> of_others;       // files of the URDF's own package about a robot with another name
  std::vector<UnreadableSrdf> unreadable{}; // of the URDF's own package
  bool operator==(const SrdfsBeside&) const = default;
};

// Looks for *.srdf in the URDF's folder, in `srdf` and `config` in it and beside it, and in the same folders of each
// package beside the URDF's own whose name ends with "moveit_config". At most 256 files are read.
SrdfsBeside srdfs_beside(const std::string& urdf_file, const std::string& robot_name);

}  // namespace contort
