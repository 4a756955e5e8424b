// Reads a robot's files: URDF with an SRDF, or MJCF with what it includes, and the meshes that they name.
#pragma once

#include <string>

#include "formats/robot/robot.h"
#include "model/core/result.h"

namespace contort {

// Returns true if the text is XML with one of the outermost elements <robot> and <mujoco>.
bool is_robot_text(std::string_view text);

// Whether a file is a robot's: by its ending, and by the first element of XML that has another ending.
bool is_robot_file(const std::string& path);

// `srdf_file` may be "". Codes of parse_urdf, add_srdf and parse_mjcf, robot.wrong_kind, and those of read_file.
Result<RobotModel> read_robot(const std::string& file, const std::string& srdf_file);

// Reads a robot with the SRDF that srdfs_beside finds for it, if it is a URDF. Notes say what was found. Codes of
// read_robot, and srdf.several if more than one fits, whose text ends with how the user can choose one.
Result<RobotModel> read_robot_with_srdf_beside(const std::string& file, std::string_view how_to_choose);

}  // namespace contort
