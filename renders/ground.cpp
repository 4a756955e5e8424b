#include "renders/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace contort {
namespace {

constexpr int kMostCells = kMostGroundTriangles / 2;
constexpr double kFinestCell_m = 0.25;  // The distance of the grid's lines: with it a twisted cell looks smooth.
constexpr double kNosing_m = 0.03;      // About 3 pixels in a tile.

// Four corners, counter-clockwise seen from outside.
using Quad = std::array<Vec3, 4>;

void add_quad(Triangles& out, const Quad& corners, const Quad& normals) {
  for (const std::size_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
    out.positions_m.push_back(corners[i]);
    out.normals.push_back(normals[i]);
  }
}

void add_flat_quad(Triangles& out, const Quad& corners) {
  const Vec3 normal = unit_or(glm::cross(corners[2] - corners[0], corners[3] - corners[1]), Vec3(0, 1, 0));
  add_quad(out, corners, {normal, normal, normal, normal});
}

// The bounding rectangle of the region in a frame that is rotated about +Y.
GroundRegion region_in(const Rigid& world_from_frame, const GroundRegion& region) {
  const Rigid frame_from_world = inverse(world_from_frame);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  GroundRegion local{kFar, kFar, -kFar, -kFar};
  for (const double x : {region.low_x_m, region.high_x_m})
    for (const double z : {region.low_z_m, region.high_z_m}) {
      const Vec3 p = frame_from_world * Vec3(x, 0.0, z);
      local = {std::min(local.low_x_m, p.x), std::min(local.low_z_m, p.z), std::max(local.high_x_m, p.x),
               std::max(local.high_z_m, p.z)};
    }
  return local;
}

// Returns `low`, `high`, and those of `count` coordinates that lie between them; these are `step` apart, from `first`
// on.
std::vector<double> cuts(double low, double high, double first, double step, double count) {
  std::vector<double> result{low};
  const double from = std::clamp(std::ceil((low - first) / step), 0.0, count);
  for (double i = from; i < count && first + i * step < high; ++i)
    if (first + i * step > low) result.push_back(first + i * step);
  result.push_back(high);
  return result;
}

// The greatest number of cuts that cuts() returns.
double cut_count(double low, double high, double step, double count) {
  return std::min((high - low) / step, count) + 3.0;
}

// Adds a cell of a grid of cuts, in the ground's frame. The normals are those of the bilinear surface over it.
void add_cell(Triangles& out, const Environment& environment, const Rigid& world_from_ground,
              const GroundRegion& cell) {
  Quad corners = {Vec3(cell.low_x_m, 0, cell.low_z_m), Vec3(cell.low_x_m, 0, cell.high_z_m),
                  Vec3(cell.high_x_m, 0, cell.high_z_m), Vec3(cell.high_x_m, 0, cell.low_z_m)};
  for (Vec3& corner : corners) {
    corner = world_from_ground * corner;
    corner.y = environment.height_at(corner.x, corner.z);
  }
  Quad normals;
  for (std::size_t i = 0; i < 4; ++i)
    normals[i] =
        unit_or(glm::cross(corners[(i + 1) % 4] - corners[i], corners[(i + 3) % 4] - corners[i]), Vec3(0, 1, 0));
  add_quad(out, corners, normals);
}

void add_grid(Triangles& out, const Environment& environment, const Rigid& world_from_ground,
              const std::vector<double>& xs, const std::vector<double>& zs) {
  for (std::size_t row = 0; row + 1 < zs.size(); ++row)
    for (std::size_t column = 0; column + 1 < xs.size(); ++column)
      add_cell(out, environment, world_from_ground, {xs[column], zs[row], xs[column + 1], zs[row + 1]});
}

GroundMesh mesh_of(const PlaneGround&, const Environment& environment, const GroundRegion& region) {
  GroundMesh mesh;
  add_cell(mesh.surface, environment, Rigid{}, region);
  return mesh;
}

GroundMesh mesh_of(const SlopeGround&, const Environment& environment, const GroundRegion& region) {
  return mesh_of(PlaneGround{}, environment, region);
}

// Cuts along the grid's own lines and, between them, enough others for small cells. If there are too many cells, it
// uses every second line, and so on.
GroundMesh mesh_of(const HeightGround& ground, const Environment& environment, const GroundRegion& region) {
  const Rigid& world_from_ground = environment.world_from_environment();
  const GroundRegion local = region_in(world_from_ground, region);
  const double half_x_m = 0.5 * (ground.columns - 1) * ground.spacing_m;
  const double half_z_m = 0.5 * (ground.rows - 1) * ground.spacing_m;
  double step_m = ground.spacing_m;
  while (step_m > kFinestCell_m) step_m *= 0.5;
  const auto cells = [&] {
    return cut_count(local.low_x_m, local.high_x_m, step_m, 2.0 * half_x_m / step_m) *
           cut_count(local.low_z_m, local.high_z_m, step_m, 2.0 * half_z_m / step_m);
  };
  while (cells() > kMostCells) step_m *= 2.0;
  const auto lines = [&](double low, double high, double half_m) {
    return cuts(low, high, -half_m, step_m, std::ceil(2.0 * half_m / step_m) + 1.0);
  };
  GroundMesh mesh;
  add_grid(mesh.surface, environment, world_from_ground, lines(local.low_x_m, local.high_x_m, half_x_m),
           lines(local.low_z_m, local.high_z_m, half_z_m));
  return mesh;
}

// A flight of steps in its own frame: +Z climbs, z = 0 is the first riser, y = 0 is the ground before it.
struct Flight {
  Rigid world_from_flight;
  double low_x_m = 0.0, high_x_m = 0.0;

  Quad tread(double low_z_m, double high_z_m, double y_m) const {
    return {at(low_x_m, y_m, low_z_m), at(low_x_m, y_m, high_z_m), at(high_x_m, y_m, high_z_m),
            at(high_x_m, y_m, low_z_m)};
  }
  Quad riser(double z_m, double low_y_m, double high_y_m) const {
    return {at(low_x_m, low_y_m, z_m), at(low_x_m, high_y_m, z_m), at(high_x_m, high_y_m, z_m),
            at(high_x_m, low_y_m, z_m)};
  }
  Vec3 at(double x_m, double y_m, double z_m) const { return world_from_flight * Vec3(x_m, y_m, z_m); }
};

Rigid place_of(const StepsGround& ground) {
  const Quat turn = axis_angle(Vec3(0, 1, 0), ground.heading_deg * kRadPerDeg);
  return {turn, turn * Vec3(0.0, 0.0, ground.start_m)};
}

GroundMesh mesh_of(const StepsGround& ground, const Environment& environment, const GroundRegion& region) {
  const Rigid world_from_flight = environment.world_from_environment() * place_of(ground);
  const GroundRegion local = region_in(world_from_flight, region);
  const Flight flight{world_from_flight, local.low_x_m, local.high_x_m};
  const double nosing_m = std::min(kNosing_m, 0.25 * ground.depth_m);
  GroundMesh mesh;
  if (local.low_z_m < 0.0) add_flat_quad(mesh.surface, flight.tread(local.low_z_m, std::min(0.0, local.high_z_m), 0.0));
  for (int step = 0; step < ground.count; ++step) {
    const bool last = step + 1 == ground.count;
    const double front_m = step * ground.depth_m, top_m = (step + 1) * ground.height_m;
    const double back_m = last ? std::max(local.high_z_m, front_m + ground.depth_m) : front_m + ground.depth_m;
    if (back_m < local.low_z_m || front_m > local.high_z_m) continue;
    add_flat_quad(mesh.surface, flight.riser(front_m, step * ground.height_m, top_m));
    add_flat_quad(mesh.nosings, flight.tread(front_m, front_m + nosing_m, top_m));
    add_flat_quad(mesh.surface, flight.tread(front_m + nosing_m, back_m, top_m));
  }
  return mesh;
}

}  // namespace

GroundMesh ground_mesh(const Environment& environment, const GroundRegion& region) {
  return std::visit([&](const auto& ground) { return mesh_of(ground, environment, region); }, environment.ground());
}

}  // namespace contort
