// Reads a robot's files: URDF with an SRDF, or MJCF with what it includes, and the meshes that they name.
#pragma once

#include <string>

#include "formats/robot/robot.h"
#include "model/core/result.h"

namespace contort {

// Returns true if the text is XML with one of the outermost elements <robot> and <mujoco>.
bool is_robot_text(std::string_view text);

// `srdf_file` may be "". Codes of parse_urdf, add_srdf and parse_mjcf, robot.wrong_kind, and those of read_file.
Result<RobotModel> read_robot(const std::string& file, const std::string& srdf_file);

}  // namespace contort
