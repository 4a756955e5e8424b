// Reads robots in MuJoCo's XML format (mujoco.readthedocs.io, "XML reference").
#pragma once

#include <functional>
#include <string_view>

#include "formats/robot/robot.h"
#include "model/core/result.h"

namespace contort {

// Returns the text of a file that the model includes, named relative to the model's folder.
using ReadIncluded = std::function<Result<std::string>(const std::string& file)>;

// Parses the text of an MJCF file. Shapes with a mesh keep the name of its file, relative to the model's folder. Of
// several robots, the one with the most joints is read. Codes mjcf.wrong_kind, .too_large, .bad_xml, .entities,
// .bad_include, .bad_number, .duplicate_name, .unknown_class, .bad_tree, .bad_type, .bad_limit, .bad_axis, .bad_mass.
Result<RobotModel> parse_mjcf(std::string_view text, const ReadIncluded& read_included);

}  // namespace contort
