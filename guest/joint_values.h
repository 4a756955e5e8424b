// A table of joint values as one execution of a character: each row is a frame at its own time. Nothing is resampled.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "formats/table/joint_table.h"
#include "model/core/result.h"
#include "model/motion/execution.h"
#include "model/motion/file_joint.h"

namespace contort {

struct JointValues {
  const JointTable& table;
  std::shared_ptr<const Character> character;
  const FileJoints& file_joints;  // joints of the file that the character was made from; empty if they are unknown
  bool in_degrees = false;        // unit of angles in columns whose names give no unit
  bool is_y_up = false;           // the root's axes: +Y up and +Z forward, else +Z up and +X forward, as robots have
  Quat file_root{1.0, 0.0, 0.0, 0.0};  // rotation at rest of the root's body in the file of the character
};

struct ValuesMotion {
  Execution execution;
  int columns = 0;                             // number of columns that move a joint
  std::vector<std::string> root_columns{};     // columns with the root's pose; seven or none
  std::vector<std::string> strange_columns{};  // columns that name no joint
  std::vector<std::string> fixed_columns{};    // columns that name a joint which is fixed in the character
  std::vector<std::string> computed{};         // joints without a column that follow another joint
  std::vector<std::string> joints_at_rest{};   // all other joints without a column
};

// A column belongs to the joint that has its name, in the file or in the character. If no joint has it, an ending such
// as "/position" is taken off, and then a path before the last slash. Joints that follow another one and have a column
// become couplings of the execution; without a column their values are computed. Times that are evenly spaced, up to
// their last digit or a hundredth of a step, are replaced by a rate. Columns of the root (root_columns.h) that belong
// to no joint give its path. Codes "check.nothing_matches", "check.too_long", "table.duplicate_joint",
// "table.wrong_unit", those of root_path.h, and the fault of a column that has a joint.
Result<ValuesMotion> motion_of_values(const JointValues& values);

}  // namespace contort
