#include "model/world/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/detmath.h"

namespace contort {

namespace {

GroundAngles angles_of(const SlopeGround& ground) {
  const det::SinCos heading = det::sincos(ground.heading_deg * kRadPerDeg);
  const det::SinCos slope = det::sincos(ground.slope_deg * kRadPerDeg);
  return {heading.sin, heading.cos, slope.sin / slope.cos};
}

GroundAngles angles_of(const StepsGround& ground) {
  const det::SinCos heading = det::sincos(ground.heading_deg * kRadPerDeg);
  return {heading.sin, heading.cos, 0.0};
}

GroundAngles angles_of(const PlaneGround&) { return {}; }
GroundAngles angles_of(const HeightGround&) { return {}; }

// The coordinate of (x, z) along the heading.
double along(const GroundAngles& angles, double x_m, double z_m) { return x_m * angles.sin + z_m * angles.cos; }

double height_of(const PlaneGround& ground, const GroundAngles&, double, double) { return ground.height_m; }

double height_of(const SlopeGround&, const GroundAngles& angles, double x_m, double z_m) {
  return along(angles, x_m, z_m) * angles.rise;
}

double height_of(const StepsGround& ground, const GroundAngles& angles, double x_m, double z_m) {
  const double climbed = std::floor((along(angles, x_m, z_m) - ground.start_m) / ground.depth_m) + 1.0;
  return ground.height_m * std::clamp(climbed, 0.0, static_cast<double>(ground.count));
}

// A cell of the grid, and the position of the point in it, in [0, 1].
struct Cell {
  int index = 0;
  double share = 0.0;
};

Cell cell_of(double coordinate_m, double spacing_m, int count) {
  const double at = std::clamp(coordinate_m / spacing_m + 0.5 * (count - 1), 0.0, static_cast<double>(count - 1));
  // NaN gets cell 0; its share stays NaN.
  const int index = at > 0.0 ? std::min(static_cast<int>(at), std::max(0, count - 2)) : 0;
  return {index, at - index};
}

double height_of(const HeightGround& ground, const GroundAngles&, double x_m, double z_m) {
  const Cell column = cell_of(x_m, ground.spacing_m, ground.columns);
  const Cell row = cell_of(z_m, ground.spacing_m, ground.rows);
  const auto at = [&](int r, int c) {
    return ground.heights_m[static_cast<std::size_t>(std::min(r, ground.rows - 1) * ground.columns +
                                                     std::min(c, ground.columns - 1))];
  };
  const double near =
      at(row.index, column.index) * (1.0 - column.share) + at(row.index, column.index + 1) * column.share;
  const double far =
      at(row.index + 1, column.index) * (1.0 - column.share) + at(row.index + 1, column.index + 1) * column.share;
  return near * (1.0 - row.share) + far * row.share;
}

double height_of(const Ground& ground, const GroundAngles& angles, double x_m, double z_m) {
  return std::visit([&](const auto& g) { return height_of(g, angles, x_m, z_m); }, ground);
}

// The normal of a slope or a grid, in the environment's frame, pointing up.
template <class Shape>
Vec3 normal_of(const Shape& ground, const GroundAngles& angles, double x_m, double z_m) {
  constexpr double kStep_m = 1e-4;  // both grounds are linear at this scale, except at the grid's own edges
  const double dx = height_of(ground, angles, x_m + kStep_m, z_m) - height_of(ground, angles, x_m - kStep_m, z_m);
  const double dz = height_of(ground, angles, x_m, z_m + kStep_m) - height_of(ground, angles, x_m, z_m - kStep_m);
  return unit_or(Vec3(-dx, 2.0 * kStep_m, -dz), Vec3(0, 1, 0));
}

// The height that no point of a ground exceeds, in the environment's frame.
double highest_of(const PlaneGround& ground) { return ground.height_m; }
double highest_of(const SlopeGround&) { return std::numeric_limits<double>::infinity(); }
double highest_of(const StepsGround& ground) { return std::max(0.0, ground.height_m * ground.count); }
double highest_of(const HeightGround& ground) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const double height : ground.heights_m) highest = std::max(highest, height);
  return highest;
}

// The smallest y of any normal of a ground. Heights between grid points are interpolated, so the ground never rises
// more steeply than between two neighbouring points.
double least_up_of(const HeightGround& ground) {
  double across_m = 0.0, along_m = 0.0;
  const auto at = [&](int r, int c) { return ground.heights_m[static_cast<std::size_t>(r * ground.columns + c)]; };
  for (int r = 0; r < ground.rows; ++r)
    for (int c = 0; c < ground.columns; ++c) {
      if (c > 0) across_m = std::max(across_m, std::fabs(at(r, c) - at(r, c - 1)));
      if (r > 0) along_m = std::max(along_m, std::fabs(at(r, c) - at(r - 1, c)));
    }
  const double a = across_m / ground.spacing_m, b = along_m / ground.spacing_m;
  return 1.0 / std::sqrt(1.0 + a * a + b * b);
}

template <class Shape>
double least_up_of(const Shape&) {
  return 1.0;
}

Surface from_centre(const Vec3& centre_m, double radius_m, const Vec3& point_m) {
  const Vec3 apart = point_m - centre_m;
  const Vec3 normal = unit_or(apart, Vec3(0, 1, 0));
  return {centre_m + radius_m * normal, normal, std::sqrt(glm::dot(apart, apart)) - radius_m, -1};
}

Surface nearest(const Sphere& sphere, const Vec3& point_m) {
  return from_centre(sphere.center_m, sphere.radius_m, point_m);
}

Surface nearest(const Capsule& capsule, const Vec3& point_m) {
  const Vec3 axis = capsule.b_m - capsule.a_m;
  const double length2 = glm::dot(axis, axis);
  const double share = length2 > 0.0 ? std::clamp(glm::dot(point_m - capsule.a_m, axis) / length2, 0.0, 1.0) : 0.0;
  return from_centre(capsule.a_m + share * axis, capsule.radius_m, point_m);
}

Surface nearest(const Box& box, const Quat& q, const Vec3& point_m) {
  const Vec3 local = glm::conjugate(q) * (point_m - box.center_m);
  Vec3 on = local, normal(0.0);
  double least = std::numeric_limits<double>::infinity();
  int face = 0;
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    on[i] = std::clamp(local[i], -box.half_m[i], box.half_m[i]);
    inside = inside && on[i] == local[i];
    const double room = box.half_m[i] - std::fabs(local[i]);
    if (room < least) least = room, face = i;
  }
  if (inside) {
    normal[face] = local[face] < 0.0 ? -1.0 : 1.0;
    on[face] = normal[face] * box.half_m[face];
    return {box.center_m + q * on, q * normal, -least, -1};
  }
  const Vec3 apart = local - on;
  return {box.center_m + q * on, q * unit_or(apart, Vec3(0, 1, 0)), std::sqrt(glm::dot(apart, apart)), -1};
}

struct Nearest {
  const Vec3& point_m;
  const Quat& turn;
  const Polyhedron& polyhedron;
  template <class Shape>
  Surface operator()(const Shape& shape) const {
    return nearest(shape, point_m);
  }
  Surface operator()(const Box& box) const { return nearest(box, turn, point_m); }
  Surface operator()(const ConvexHull&) const {
    const OnSurface on = nearest_on(polyhedron, point_m);
    return {on.point_m, on.normal, on.distance_m, -1};
  }
};

Result<Done> check_obstacles(std::span<const ObstacleDesc> obstacles) {
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const std::string pointer = "/obstacles/" + std::to_string(i);
    for (std::size_t j = 0; j < i; ++j)
      if (obstacles[i].name == obstacles[j].name)
        return Issue{"environment.duplicate_name", pointer + "/name", "found \"" + obstacles[i].name + "\" twice"};
    const auto* hull = std::get_if<ConvexHull>(&obstacles[i].shape);
    const std::string fault = hull == nullptr ? "" : hull_fault(hull->points_m);
    if (!fault.empty()) return Issue{"environment.bad_shape", pointer + "/shape/points_m", fault};
  }
  return Done{};
}

Result<Done> check_heights(const Ground& ground) {
  const auto* grid = std::get_if<HeightGround>(&ground);
  if (grid == nullptr) return Done{};
  const std::size_t expected = static_cast<std::size_t>(grid->columns) * static_cast<std::size_t>(grid->rows);
  if (grid->heights_m.size() == expected) return Done{};
  return Issue{"environment.wrong_count", "/ground/heights_m",
               "found " + std::to_string(grid->heights_m.size()) +
                   " heights, expected columns times rows: " + std::to_string(expected)};
}

}  // namespace

Environment::Environment(const EnvironmentDesc& desc)
    : world_from_environment_{axis_angle(Vec3(0, 1, 0), desc.heading_deg * kRadPerDeg), desc.position_m},
      environment_from_world_(inverse(world_from_environment_)),
      ground_(desc.ground),
      angles_(std::visit([](const auto& ground) { return angles_of(ground); }, ground_)),
      obstacles_(desc.obstacles),
      level_(std::holds_alternative<PlaneGround>(desc.ground)) {
  if (const auto* plane = std::get_if<PlaneGround>(&ground_))
    level_m_ = plane->height_m + world_from_environment_.p_m.y;
  is_flat_ = level_ || std::holds_alternative<StepsGround>(ground_);
  up_ = world_from_environment_.q * Vec3(0, 1, 0);
  highest_m_ = std::visit([](const auto& g) { return highest_of(g); }, ground_) + world_from_environment_.p_m.y;
  least_up_ = std::visit([](const auto& g) { return least_up_of(g); }, ground_) / std::sqrt(1.0 + angles_.rise * angles_.rise);
  for (const ObstacleDesc& obstacle : obstacles_) {
    const auto* box = std::get_if<Box>(&obstacle.shape);
    turns_.push_back(box == nullptr ? kNoRotation : from_rotation_vector(box->rotation_deg * kRadPerDeg));
    const auto* hull = std::get_if<ConvexHull>(&obstacle.shape);
    polyhedra_.push_back(hull == nullptr ? Polyhedron{} : convex_polyhedron(hull->points_m));
  }
}

double Environment::height_at(double x_m, double z_m) const {
  if (level_) return level_m_;
  const Vec3 at = local({x_m, 0.0, z_m});
  return height_of(ground_, angles_, at.x, at.z) + world_from_environment_.p_m.y;
}

Vec3 Environment::normal_at(double x_m, double z_m) const {
  if (is_flat_) return up_;
  const Vec3 at = local({x_m, 0.0, z_m});
  return world_from_environment_.q *
         std::visit([&](const auto& ground) { return normal_of(ground, angles_, at.x, at.z); }, ground_);
}

// Ground whose greatest slope has the tangent t lies below a cone of that slope over any of its points, and the y of
// its normals is at least least_up_ = 1 / sqrt(1 + t^2). So every point of a ball is at least this far away: the height
// of its centre over the ground times least_up_, minus its radius. Steps have no such tangent and are bounded by their
// highest tread.
bool Environment::is_surely_over_ground(const Vec3& center_m, double radius_m, double distance_m) const {
  constexpr double kRounding_m = 1e-9, kRoundingShare = 1e-6;  // more than the rounding errors of the distance itself
  const double needed_m =
      std::max(0.0, distance_m + radius_m + kRounding_m) / (least_up_ * (1.0 - kRoundingShare));
  if (center_m.y - highest_m_ > needed_m) return true;
  return !std::holds_alternative<StepsGround>(ground_) &&
         center_m.y - height_at(center_m.x, center_m.z) > needed_m;
}

Surface Environment::nearest_ground(const Vec3& point_m) const {
  const Vec3 normal = normal_at(point_m.x, point_m.z);
  const double above_m = point_m.y - height_at(point_m.x, point_m.z);
  const double distance_m = above_m * normal.y;
  return {point_m - distance_m * normal, normal, distance_m, -1};
}

Surface Environment::nearest_obstacle(const Vec3& point_m) const {
  const Vec3 at = local(point_m);
  Surface best;
  best.distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    Surface surface = std::visit(Nearest{at, turns_[i], polyhedra_[i]}, obstacles_[i].shape);
    surface.obstacle = static_cast<int>(i);
    if (surface.distance_m < best.distance_m) best = surface;
  }
  best.point_m = world_from_environment_ * best.point_m;
  best.normal = world_from_environment_.q * best.normal;
  return best;
}

int Environment::find_obstacle(std::string_view name) const {
  for (std::size_t i = 0; i < obstacles_.size(); ++i)
    if (obstacles_[i].name == name) return static_cast<int>(i);
  return -1;
}

Result<Environment> build_environment(const EnvironmentDesc& desc) {
  if (Result<Done> done = check_heights(desc.ground); !done) return done.issue();
  if (Result<Done> done = check_obstacles(desc.obstacles); !done) return done.issue();
  return Environment(desc);
}

}  // namespace contort
