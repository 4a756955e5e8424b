// The surroundings of a character: ground as a height over the plane, and solid obstacles. Queries are pure and do not
// allocate. World coordinates in and out.
#pragma once

#include <span>

#include "model/character/polyhedron.h"
#include "model/core/result.h"
#include "model/world/environment_desc.h"

namespace contort {

// The nearest point of a surface, its outward normal there, and the signed distance of the query point: < 0 inside.
struct Surface {
  Vec3 point_m{0.0};
  Vec3 normal{0.0, 1.0, 0.0};
  double distance_m = 0.0;
  int obstacle = -1;  // -1: the ground
};

// The angles of a ground, precomputed for queries.
struct GroundAngles {
  double sin = 0.0;  // sine of the heading of a slope or steps
  double cos = 1.0;
  double rise = 0.0;  // tangent of a slope
};

class Environment {
 public:
  Environment() = default;  // a level plane at height 0

  double height_at(double x_m, double z_m) const;
  // The unit normal of the ground; on steps that of the tread.
  Vec3 normal_at(double x_m, double z_m) const;
  bool is_level() const { return level_; }

  // Distance to the ground is along its normal under the point, exact for planes and slopes.
  Surface nearest_ground(const Vec3& point_m) const;
  // Returns true if a cheap test proves that nearest_ground() is farther than distance_m for each point of a ball.
  // False means that the test proved nothing.
  bool is_surely_over_ground(const Vec3& center_m, double radius_m, double distance_m) const;
  // Returns obstacle = -1 and an infinite distance if there are no obstacles.
  Surface nearest_obstacle(const Vec3& point_m) const;

  // The ground and obstacles of the description, in the environment's own frame.
  const Rigid& world_from_environment() const { return world_from_environment_; }
  const Ground& ground() const { return ground_; }
  std::span<const ObstacleDesc> obstacles() const { return obstacles_; }
  int find_obstacle(std::string_view name) const;  // -1 if there is none

 private:
  friend Result<Environment> build_environment(const EnvironmentDesc& desc);
  explicit Environment(const EnvironmentDesc& desc);
  Vec3 local(const Vec3& point_m) const { return environment_from_world_ * point_m; }

  Rigid world_from_environment_;
  Rigid environment_from_world_;
  Ground ground_;
  GroundAngles angles_;
  std::vector<ObstacleDesc> obstacles_;  // in the environment's frame
  std::vector<Quat> turns_;              // rotations of obstacles that are boxes; no rotation for the others
  std::vector<Polyhedron> polyhedra_;    // hulls of obstacles that are hulls; empty for the others
  bool level_ = true;
  double level_m_ = 0.0;   // height of level ground, in the world
  bool is_flat_ = true;    // its normal is the same everywhere: level ground, and the treads of steps
  Vec3 up_{0.0, 1.0, 0.0};  // the normal of flat ground, in the world
  double highest_m_ = 0.0;  // height that no ground exceeds, in the world
  double least_up_ = 1.0;   // smallest y of any normal
};

// Codes environment.wrong_count (heights), .duplicate_name, .bad_shape; pointers from the description's root.
Result<Environment> build_environment(const EnvironmentDesc& desc);

}  // namespace contort
