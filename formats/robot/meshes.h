// Reads the meshes of a robot's collision shapes, of which a character keeps the convex hull.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/robot/robot.h"
#include "model/core/result.h"

namespace contort {

// Returns the vertices of an STL file (binary or text), or of an OBJ file if `ending` is ".obj". Codes mesh.truncated,
// mesh.bad_number, mesh.no_vertices, mesh.other_format.
Result<std::vector<Vec3>> mesh_points(std::string_view bytes, std::string_view ending);

// Returns the path of a mesh that a robot's file names, "package://arm/meshes/a.stl" or "../meshes/a.stl"; "" if it is
// not found. It must lie in the folder of the package, or below the folder to which the ".." of the name lead.
std::string find_mesh(const std::string& robot_file, const std::string& name);

// Replaces each mesh whose file is found by its hull. The others stay, with a note.
void load_meshes(const std::string& robot_file, RobotModel& robot);

}  // namespace contort
