#include "renders/range_marks.h"

#include <algorithm>
#include <cmath>

#include "model/core/detmath.h"
#include "model/core/index.h"
#include "renders/response_marks.h"

namespace contort {
namespace {

constexpr double kShare = 0.8;       // radius as a fraction of the limb's length
constexpr double kStep_rad = 0.1;    // step of an arc; 6 degrees look round
constexpr double kLeastLever = 0.1;  // sine below which a limb lies along its axis
constexpr int kConeCorners = 64;
constexpr Vec3 kBeyondColor{0.80, 0.03, 0.03};

// Adds the triangle for both sides, so that it is visible from both.
void add_two_sided(Triangles& triangles, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = unit_or(glm::cross(b - a, c - a), Vec3(0, 1, 0));
  for (const Vec3& corner : {a, b, c}) triangles.positions_m.push_back(corner), triangles.normals.push_back(normal);
  for (const Vec3& corner : {a, c, b}) triangles.positions_m.push_back(corner), triangles.normals.push_back(-normal);
}

void add_mark(DrawList& list, std::vector<Triangles>& meshes, Triangles triangles, const Vec3& color, bool ghost) {
  if (triangles.positions_m.empty()) return;
  add_instance(
      list,
      {.mesh = static_cast<int>(meshes.size()), .world_from_mesh = {}, .color = color, .ghost = ghost, .mark = true});
  meshes.push_back(std::move(triangles));
}

double radius_of(const Vec3& arm_m) { return std::clamp(kShare * glm::length(arm_m), kLeastRange_m, kMostRange_m); }

// A hinge and the limb that it turns, in the world.
struct Hinge {
  Vec3 center_m, axis, across;  // across: unit, at a right angle to the axis, along the limb at the present angle
  double radius_m;

  Vec3 rim(double turned_rad) const { return center_m + radius_m * (axis_angle(axis, turned_rad) * across); }
  Triangles sector(double from_rad, double to_rad) const {
    Triangles fan;
    const int steps = static_cast<int>(std::ceil((to_rad - from_rad) / kStep_rad));
    for (int i = 0; i < steps; ++i)
      add_two_sided(fan, center_m, rim(from_rad + (to_rad - from_rad) * i / steps),
                    rim(from_rad + (to_rad - from_rad) * (i + 1) / steps));
    return fan;
  }
};

void add_hinge(const Joint& joint, const Rigid& place, const Vec3& lever_m, double angle_rad, DrawList& list,
               std::vector<Triangles>& meshes) {
  const Vec3 axis = place.q * joint.axis, arm_m = lever_m - place.p_m;
  Vec3 across = arm_m - glm::dot(arm_m, axis) * axis;
  if (glm::length(across) < kLeastLever * glm::length(arm_m) || glm::length(across) == 0.0)
    across = std::fabs(axis.y) < 0.9 ? glm::cross(axis, Vec3(0, 1, 0)) : glm::cross(axis, Vec3(0, 0, 1));
  const Hinge hinge{place.p_m, axis, unit_or(across, Vec3(0, 0, 1)), radius_of(arm_m)};
  add_mark(list, meshes, hinge.sector(joint.low - angle_rad, joint.high - angle_rad), kAllowedColor, true);
  if (angle_rad > joint.high) add_mark(list, meshes, hinge.sector(joint.high - angle_rad, 0.0), kBeyondColor, false);
  if (angle_rad < joint.low) add_mark(list, meshes, hinge.sector(0.0, joint.low - angle_rad), kBeyondColor, false);
}

// Draws the limb's directions at the rim of the swing's ellipse (as fuzz/compose_params.cpp draws swings).
void add_ball(const Joint& joint, const Rigid& place, const Vec3& lever_m, const Quat& turned, DrawList& list,
              std::vector<Triangles>& meshes) {
  const Quat center = place.q * glm::conjugate(turned) * joint.swing_center;
  const Vec3 other = glm::cross(joint.axis, joint.swing_axis);
  const double radius_m = radius_of(lever_m - place.p_m);
  const auto rim = [&](int corner) {
    const det::SinCos around = det::sincos(2.0 * kPi * corner / kConeCorners);
    const Vec3 swing = joint.swing_a_rad * around.cos * joint.swing_axis + joint.swing_b_rad * around.sin * other;
    return place.p_m + radius_m * (center * (from_rotation_vector(swing) * joint.axis));
  };
  // The twist axis may point in the direction opposite to the limb.
  const Vec3 along = glm::conjugate(place.q) * (lever_m - place.p_m);
  const double sign = glm::dot(along, joint.axis) < 0.0 ? -1.0 : 1.0;
  Triangles cone;
  for (int i = 0; i < kConeCorners; ++i)
    add_two_sided(cone, place.p_m, place.p_m + sign * (rim(i) - place.p_m),
                  place.p_m + sign * (rim(i + 1) - place.p_m));
  add_mark(list, meshes, std::move(cone), kAllowedColor, true);
}

}  // namespace

void add_range_mark(const Character& character, int index, std::span<const Rigid> world, std::span<const double> row,
                    DrawList& list, std::vector<Triangles>& meshes) {
  const Joint& joint = character.joints()[at(index)];
  const Rigid& place = world[at(index)];
  const Vec3 lever_m = lever_point_m(character, world, index);
  if (!std::isfinite(glm::dot(lever_m, lever_m) + glm::dot(place.p_m, place.p_m))) return;
  const std::span<const double> own = row.subspan(at(joint.coord));
  if (joint.kind == JointKind::hinge) add_hinge(joint, place, lever_m, own[0], list, meshes);
  if (joint.kind == JointKind::ball)
    add_ball(joint, place, lever_m, Quat(own[0], own[1], own[2], own[3]), list, meshes);
}

}  // namespace contort
