#include "guest/on_the_spot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// All are fractions of the root's height at rest.
constexpr double kFoot = 0.15;
constexpr double kTouch = 0.03;
constexpr double kStays = 0.25;
constexpr double kPulled = 0.1;
constexpr double kSameWay = 0.8;  // smallest cosine of the angle between equal directions

double level_length(const Vec3& v) { return std::sqrt(v.x * v.x + v.z * v.z); }

std::vector<int> feet_of(const Character& character) {
  std::vector<Rigid> rest(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), rest);
  std::vector<char> carries(rest.size(), 0);
  for (const Joint& joint : character.joints().subspan(1)) carries[at(joint.parent)] = 1;
  std::vector<int> feet;
  for (int j = 1; j < static_cast<int>(rest.size()); ++j)
    if (carries[at(j)] == 0 && rest[at(j)].p_m.y < kFoot * rest[0].p_m.y) feet.push_back(j);
  return feet;
}

// Positions of joints over the motion: by joint, then frame.
std::vector<std::vector<Vec3>> paths_of(const Execution& execution, const std::vector<int>& joints) {
  const Motion& motion = execution.motion;
  std::vector<Rigid> world(execution.character->joints().size());
  std::vector<std::vector<Vec3>> paths(joints.size());
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    forward_kinematics(*execution.character, motion.root[at(frame)], motion.row(frame), world);
    for (std::size_t i = 0; i < joints.size(); ++i) paths[i].push_back(world[at(joints[i])].p_m);
  }
  return paths;
}

// The horizontal movement of a foot while it touches the ground.
Vec3 pulled(const std::vector<Vec3>& path, double touch_m) {
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const Vec3& place : path) lowest_m = std::min(lowest_m, place.y);
  Vec3 way(0.0);
  for (std::size_t f = 1; f < path.size(); ++f)
    if (std::max(path[f - 1].y, path[f].y) < lowest_m + touch_m) way += path[f] - path[f - 1];
  return {way.x, 0.0, way.z};
}

bool stays(const Motion& motion, double within_m) {
  return std::ranges::all_of(motion.root, [&](const Rigid& root) {
    return level_length(root.p_m - motion.root.front().p_m) < within_m;
  });
}

}  // namespace

RootPath path_of(const Execution& execution) {
  const double height_m = execution.character->rest_root().p_m.y;
  if (!stays(execution.motion, kStays * height_m)) return RootPath::told;
  std::vector<Vec3> ways;
  for (const std::vector<Vec3>& path : paths_of(execution, feet_of(*execution.character)))
    if (const Vec3 way = pulled(path, kTouch * height_m); level_length(way) > kPulled * height_m) ways.push_back(way);
  const bool is_one_way = std::ranges::all_of(ways, [&](const Vec3& way) {
    return glm::dot(way, ways.front()) > kSameWay * level_length(way) * level_length(ways.front());
  });
  return ways.size() >= 2 && is_one_way ? RootPath::on_the_spot : RootPath::told;
}

}  // namespace contort
