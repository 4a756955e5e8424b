#include "formats/robot/meshes.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "formats/robot/shapes.h"
#include "formats/robot/xml.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxMeshBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxAllMeshBytes = std::size_t{512} << 20;
constexpr std::size_t kStlHeader = 84;  // 80 bytes of text, and the number of triangles
constexpr std::size_t kStlTriangle = 50;
constexpr int kMostFoldersUp = 3;

float float_at(const char* bytes) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) word = word << 8 | static_cast<unsigned char>(bytes[i]);
  return std::bit_cast<float>(word);
}

bool is_finite(const Vec3& p) {
  for (int i = 0; i < 3; ++i)
    if (!(std::fabs(p[i]) <= 1e9)) return false;
  return true;
}

std::optional<std::size_t> triangles_of_binary(std::string_view bytes) {
  if (bytes.size() < kStlHeader) return {};
  std::size_t count = 0;
  for (std::size_t i = 4; i-- > 0;) count = count << 8 | static_cast<unsigned char>(bytes[80 + i]);
  if (bytes.size() - kStlHeader < count * kStlTriangle) return {};
  return count;
}

Result<std::vector<Vec3>> points_of_binary(std::string_view bytes, std::size_t triangles) {
  std::vector<Vec3> out;
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const char* at = bytes.data() + kStlHeader + t * kStlTriangle + 12 + corner * 12;
      const Vec3 p(float_at(at), float_at(at + 4), float_at(at + 8));
      if (!is_finite(p)) return Issue{"mesh.bad_number", "", "a vertex is not finite"};
      out.push_back(p);
    }
  return out;
}

// Reads lines such as "vertex 1 2 3" in an STL, and "v 1 2 3" in an OBJ.
Result<std::vector<Vec3>> points_of_lines(std::string_view text, std::string_view word) {
  std::vector<Vec3> out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with(word) || line.size() <= word.size() ||
        (line[word.size()] != ' ' && line[word.size()] != '\t'))
      continue;
    const auto numbers = numbers_in(line.substr(word.size()), 7);  // an OBJ may add a weight and a colour
    if (!numbers || numbers->size() < 3) return Issue{"mesh.bad_number", "", "a vertex is not three finite numbers"};
    out.emplace_back((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  }
  return out;
}

bool is_plain_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// Returns BASE/REST if it is a file inside of BASE.
std::string inside(const fs::path& base, const fs::path& rest) {
  for (const fs::path& step : rest)
    if (step == "..") return "";
  const fs::path path = base / rest;
  return is_plain_file(path) && check_inside(base.string(), path.string()).ok() ? path.string() : "";
}

// Finds the package. It is a folder of that name around the robot's file, or beside such a folder. Otherwise it is a
// folder around the robot's file that has the mesh, because a copy of a package often has another name.
std::string find_in_package(const fs::path& folder, const std::string& rest) {
  const std::size_t slash = rest.find('/');
  if (slash == std::string::npos || slash == 0) return "";
  const std::string package = rest.substr(0, slash), file = rest.substr(slash + 1);
  if (!is_file_name(package)) return "";
  for (fs::path at = folder; !at.empty(); at = at.parent_path()) {
    const fs::path own = at.filename() == package ? at : at / package;
    if (const std::string found = inside(own, file); !found.empty()) return found;
    if (at == at.parent_path()) break;
  }
  fs::path around = folder;
  for (int up = 0; up <= kMostFoldersUp && around != around.parent_path(); ++up, around = around.parent_path())
    if (const std::string found = inside(around, file); !found.empty()) return found;
  return "";
}

struct MeshCache {
  std::map<std::string, std::vector<Vec3>> points;  // by path; empty for unreadable files
  std::size_t bytes = 0;
};

const std::vector<Vec3>& points_of(const std::string& path, MeshCache& cache, RobotModel& robot) {
  const auto [entry, is_new] = cache.points.try_emplace(path);
  if (!is_new) return entry->second;
  const Result<std::string> bytes = read_file(path, kMaxMeshBytes);
  cache.bytes += bytes ? bytes->size() : 0;
  const bool fits = cache.bytes <= kMaxAllMeshBytes;
  const Result<std::vector<Vec3>> points =
      !bytes ? Result<std::vector<Vec3>>(bytes.issue())
      : fits ? mesh_points(*bytes, fs::path(path).extension().string())
             : Result<std::vector<Vec3>>(Issue{"mesh.too_large", "", "all meshes together are too large"});
  if (points)
    entry->second = *points;
  else
    note(robot,
         "The mesh " + quoted_name(fs::path(path).filename().string()) + " is not read: " + points.issue().text + ".");
  return entry->second;
}

void place_hull(RobotShape& shape, const std::vector<Vec3>& points) {
  std::vector<Vec3> placed;
  for (const Vec3& p : points) placed.push_back(shape.body_from_mesh * (shape.mesh_scale * p));
  const ConvexHull hull = hull_around(placed);
  if (hull.points_m.empty()) return;
  shape.shape = hull;
  shape.mesh.clear();
}

}  // namespace

Result<std::vector<Vec3>> mesh_points(std::string_view bytes, std::string_view ending) {
  std::string lower;
  for (const char c : ending) lower += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (lower != ".stl" && lower != ".obj")
    return Issue{"mesh.other_format", "", "only .stl and .obj are read, found " + quoted_name(lower)};
  const std::optional<std::size_t> triangles = lower == ".stl" ? triangles_of_binary(bytes) : std::nullopt;
  if (lower == ".stl" && !triangles && !bytes.starts_with("solid"))
    return Issue{"mesh.truncated", "", "the STL file is shorter than its number of triangles"};
  Result<std::vector<Vec3>> points =
      triangles ? points_of_binary(bytes, *triangles) : points_of_lines(bytes, lower == ".obj" ? "v" : "vertex");
  if (points && points->empty()) return Issue{"mesh.no_vertices", "", "it has no vertices"};
  return points;
}

std::string find_mesh(const std::string& robot_file, const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::absolute(robot_file, error).parent_path();
  for (const std::string_view scheme : {"package://", "model://"})
    if (name.starts_with(scheme)) return find_in_package(folder, name.substr(scheme.size()));
  if (name.empty() || name.find("://") != std::string::npos || name.front() == '/') return "";
  fs::path base = folder, rest = fs::path(name).lexically_normal();
  for (int up = 0; up < kMostFoldersUp && rest.begin() != rest.end() && *rest.begin() == ".."; ++up) {
    base = base.parent_path();
    rest = rest.lexically_relative("..");
  }
  return inside(base, rest);
}

void load_meshes(const std::string& robot_file, RobotModel& robot) {
  MeshCache cache;
  std::set<std::string> missing;
  for (RobotBody& body : robot.bodies)
    for (RobotShape& shape : body.shapes) {
      if (shape.mesh.empty()) continue;
      const std::string path = find_mesh(robot_file, shape.mesh);
      if (path.empty())
        missing.insert(shape.mesh);
      else if (const std::vector<Vec3>& points = points_of(path, cache, robot); !points.empty())
        place_hull(shape, points);
    }
  std::vector<std::string> names;
  for (const std::string& name : missing) names.push_back(fs::path(name).filename().string());
  note_all(robot, std::to_string(names.size()) + " meshes of collision shapes are not found", names);
}

}  // namespace contort
