#include "checks/withstands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/geometry/solid_points.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// Points up to this far above the lowest one touch the ground: soles at rest differ in height.
constexpr double kTouches_m = 0.02;
// Speed of the centre of mass below which a figure stands still; faster figures are judged by the support at rest.
constexpr double kStill_m_s = 0.2;
constexpr int kDirections = 64;  // number of normals that approximate the edge of the support, to 0.1 % for a round one
constexpr double kSidelong = 1e-3;  // edges whose cosine to the push is smaller are ignored: a push does not reach them
constexpr double kGravity_m_s2 = 9.81;  // g

struct Balance {
  Vec3 com_m{0.0};
  double height_m = 0.0;  // height of the centre of mass above the lowest point
  double room_m = 0.0;    // distance of the centre of mass from the edge of the support along the push, < 0 outside
};

std::vector<Rigid> placed(const Character& character, const Rigid& root, std::span<const double> row) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, root, row, world);
  return world;
}

double mass_of(const Character& character) {
  double mass_kg = 0.0;
  for (const Joint& joint : character.joints()) mass_kg += joint.mass_kg;
  return mass_kg;
}

Vec3 com_of(const Character& character, std::span<const Rigid> world) {
  Vec3 sum(0.0);
  for (std::size_t j = 0; j < world.size(); ++j)
    sum += character.joints()[j].mass_kg * (world[j] * character.joints()[j].center_of_mass_m);
  return sum / mass_of(character);
}

// The horizontal direction of a vector; forward if it has none.
Vec3 level(const Vec3& v) {
  const double size = std::sqrt(v.x * v.x + v.z * v.z);
  return size > 0.0 ? Vec3(v.x / size, 0.0, v.z / size) : Vec3(0.0, 0.0, 1.0);
}

// The lowest points of all colliders, up to kTouches_m above the very lowest.
std::vector<Vec3> low_points(const Character& character, std::span<const Rigid> world) {
  std::vector<Vec3> points;
  for (const Collider& collider : character.colliders()) {
    const Solid solid = moved(world[at(collider.joint)], solid_of(collider.shape));
    for (const Vec3& core : core_points(solid)) points.push_back(core - Vec3(0.0, solid.radius_m, 0.0));
  }
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const Vec3& point : points) lowest_m = std::min(lowest_m, point.y);
  std::erase_if(points, [&](const Vec3& point) { return point.y > lowest_m + kTouches_m; });
  return points;
}

// The distance from a point to the edge of a convex hull along a direction: for each edge, its normal distance divided
// by the cosine between normal and direction.
double room_in(std::span<const Vec3> support, const Vec3& point, const Vec3& direction) {
  double room_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kDirections; ++i) {
    const det::SinCos turn = det::sincos(2.0 * kPi * i / kDirections);
    const double along = turn.cos * direction.x + turn.sin * direction.z;
    if (along < kSidelong) continue;
    double reach_m = -std::numeric_limits<double>::infinity();
    for (const Vec3& corner : support)
      reach_m = std::max(reach_m, turn.cos * (corner.x - point.x) + turn.sin * (corner.z - point.z));
    room_m = std::min(room_m, reach_m / along);
  }
  return room_m;
}

Balance balance_of(const Character& character, const Rigid& root, std::span<const double> row, const Vec3& direction) {
  const std::vector<Rigid> world = placed(character, root, row);
  const std::vector<Vec3> support = low_points(character, world);
  Balance out;
  out.com_m = com_of(character, world);
  if (support.empty()) return out;
  out.height_m = std::max(out.com_m.y - support.front().y, kTouches_m);
  out.room_m = room_in(support, out.com_m, direction);
  return out;
}

double impulse_of(const Character& character, const Balance& balance) {
  if (balance.height_m <= 0.0) return 0.0;
  return mass_of(character) * std::max(balance.room_m, 0.0) * std::sqrt(kGravity_m_s2 / balance.height_m);
}

}  // namespace

double withstands_N_s(const Character& character, const Motion& motion, int frame, const Vec3& direction) {
  const int before = std::max(frame - 1, 0), earlier = std::max(frame - 2, 0);
  const Rigid& root = motion.root[at(before)];
  const Vec3 of_figure = level(character.rest_root().q * (glm::conjugate(root.q) * direction));
  const double at_rest = character.declared_withstands_N_s().value_or(
      impulse_of(character, balance_of(character, character.rest_root(), character.rest_coords(), of_figure)));
  const Balance now = balance_of(character, root, motion.row(before), direction);
  const Balance then = balance_of(character, motion.root[at(earlier)], motion.row(earlier), direction);
  const double speed_m_s = length(now.com_m - then.com_m) * motion.rate_hz;
  return speed_m_s < kStill_m_s ? std::min(at_rest, impulse_of(character, now)) : at_rest;
}

std::optional<Blow> overpowering_blow(const Character& character, const Motion& motion) {
  for (const ImpactMark& impact : motion.response.impacts) {
    const double across = length(Vec3(impact.impulse_N_s.x, 0.0, impact.impulse_N_s.z));
    if (across == 0.0) continue;
    const Vec3 direction = level(impact.impulse_N_s);
    const Blow blow{impact.frame, across, withstands_N_s(character, motion, impact.frame, direction)};
    if (blow.is_overpowering()) return blow;
  }
  return std::nullopt;
}

int first_overpowered_frame(const Character& character, const Motion& motion) {
  const std::optional<Blow> blow = overpowering_blow(character, motion);
  return blow ? blow->frame : motion.frame_count;
}

}  // namespace contort
