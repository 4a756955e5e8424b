// Reads a robot's files: URDF with an SRDF, or MJCF with its included files, and the meshes that they name.
#pragma once

#include <string>

#include "formats/robot/robot.h"
#include "model/core/result.h"

namespace contort {

// Returns true if the text is XML with one of the outermost elements <robot> and <mujoco>.
bool is_robot_text(std::string_view text);

// Returns true for a robot's file: by its ending, or by its first XML element.
bool is_robot_file(const std::string& path);

// `srdf_file` may be "". Codes of parse_urdf, add_srdf and parse_mjcf, robot.wrong_kind, and those of read_file.
Result<RobotModel> read_robot(const std::string& file, const std::string& srdf_file);

// Reads a robot with the SRDF that srdfs_beside finds, if it is a URDF. Notes name the found files. Codes of
// read_robot, and srdf.several if more than one fits; its text ends with the way to choose one.
Result<RobotModel> read_robot_with_srdf_beside(const std::string& file, std::string_view how_to_choose);

}  // namespace contort
