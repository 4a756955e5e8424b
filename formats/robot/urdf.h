// Reads robots in the Unified Robot Description Format (wiki.ros.org/urdf/XML), and the pairs of links that its
// companion SRDF says may touch (wiki.ros.org/srdf).
#pragma once

#include <string>
#include <string_view>

#include "formats/robot/robot.h"
#include "model/core/result.h"

namespace contort {

// Parses the text of a URDF file. Shapes with a mesh keep the name of its file. Codes urdf.wrong_kind, .xacro,
// .too_large, .bad_xml, .entities, .bad_number, .no_name, .duplicate_name, .unknown_link, .bad_tree, .bad_type,
// .bad_limit, .bad_axis, .bad_shape, .bad_mass.
Result<RobotModel> parse_urdf(std::string_view text);

// Adds the pairs of an SRDF's text to the robot. Codes srdf.wrong_kind, .xacro, .too_large, .bad_xml, .entities,
// .unknown_link, .no_name.
Result<Done> add_srdf(std::string_view text, RobotModel& robot);

// Returns the name of the robot that an SRDF's text is about; "" if it names none. Codes srdf.wrong_kind, .xacro,
// .too_large, .bad_xml, .entities.
Result<std::string> robot_of_srdf(std::string_view text);

}  // namespace contort
