#include "renders/response_marks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "renders/arrow.h"

namespace contort {
namespace {

constexpr double kOwnPlace_m = 0.01;
constexpr double kOnAxis = 0.05;  // Sine of the angle between axis and lever; below it no rotation is visible.
constexpr double kBallRadius_m = 0.022;
constexpr double kLifted_m = 0.004;        // A patch exactly on the ground would flicker.
constexpr double kFarOutside_m = 0.5;  // With a ball farther away, the camera would show everything else very small.
constexpr double kShortestImpact_m = 0.1;  // Even a weak blow is drawn with this length.

void add_shape(DrawList& list, std::vector<Triangles>& meshes, Triangles triangles, DrawInstance instance) {
  instance.mesh = static_cast<int>(meshes.size());
  meshes.push_back(std::move(triangles));
  add_instance(list, instance);
}

void add_arrow(DrawList& list, std::vector<Triangles>& meshes, const Vec3& from_m, const Vec3& along, double length_m,
               const Vec3& color) {
  if (!(length_m >= kLeastArrow_m)) return;  // also true for NaN
  const double shown_m = std::min(length_m, kLongestArrow_m);
  add_shape(list, meshes, arrow_triangles(shown_m),
            {.world_from_mesh = arrow_place(from_m, along), .color = color, .mark = true});
}

// The only child of this joint, or -1.
int only_child(const Character& character, int joint) {
  int child = -1;
  for (int j = joint + 1; j < static_cast<int>(character.joints().size()); ++j) {
    if (character.joints()[at(j)].parent != joint) continue;
    if (child >= 0) return -1;
    child = j;
  }
  return child;
}

// The accelerations that control adds to the joint's own degrees of freedom.
std::span<const double> control_of(const ResponseFrame& of, int joint) {
  const Response& response = of.motion.response;
  int before = 0;
  for (int j = 0; j < joint; ++j) before += freedom_count(of.character.joints()[at(j)].kind);
  return std::span(response.control)
      .subspan(at(of.frame) * at(response.dof_count) + at(before), at(freedom_count(of.character.joints()[at(joint)].kind)));
}

void add_turning_arrow(const ResponseFrame& of, int joint, const Vec3& acceleration_rad_s2, DrawList& list,
                       std::vector<Triangles>& meshes) {
  const Vec3 lever_m = lever_point_m(of.character, of.world, joint);
  const Vec3 arm_m = lever_m - of.world[at(joint)].p_m;
  const Vec3 pull = glm::cross(acceleration_rad_s2, arm_m);
  const double size = glm::length(acceleration_rad_s2);
  if (glm::length(pull) <= kOnAxis * size * glm::length(arm_m)) return;
  add_arrow(list, meshes, lever_m, unit_or(pull, Vec3(0, 1, 0)), kArrow_m_per_rad_s2 * size, kControlColor);
}

// Adds an arrow along an acceleration.
void add_pushing_arrow(const Vec3& from_m, const Vec3& acceleration_m_s2, DrawList& list,
                       std::vector<Triangles>& meshes) {
  const double size = glm::length(acceleration_m_s2);
  add_arrow(list, meshes, from_m, unit_or(acceleration_m_s2, Vec3(0, 1, 0)), kArrow_m_per_m_s2 * size, kControlColor);
}

bool is_placed(const ResponseFrame& of) {
  return std::ranges::all_of(of.world,
                             [](const Rigid& place) { return std::isfinite(glm::dot(place.p_m, place.p_m)); });
}

// > 0 if a, b, c turn to the left seen from above (from +Y down).
double turn_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z);
}

// The convex hull of points seen from above, counter-clockwise (A. M. Andrew, "Another efficient algorithm for convex
// hulls in two dimensions", 1979): the lower chain in order of z and x, then the upper chain in reverse order.
std::vector<Vec3> hull_from_above(std::vector<Vec3> points) {
  std::ranges::sort(points, [](const Vec3& a, const Vec3& b) { return std::pair(a.z, a.x) < std::pair(b.z, b.x); });
  std::vector<Vec3> hull;
  const auto extend = [&](const auto& chain) {
    const std::size_t first = hull.size();
    for (const Vec3& point : chain) {
      while (hull.size() >= first + 2 && turn_of(hull[hull.size() - 2], hull.back(), point) <= 0.0) hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();  // the other chain begins with it
  };
  if (points.size() < 3) return {};
  extend(points);
  extend(std::vector<Vec3>(points.rbegin(), points.rend()));
  return hull;
}

// The corners of the area between the standing soles, counter-clockwise seen from above.
std::vector<Vec3> support_corners(const ResponseFrame& of) {
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < of.legs.size(); ++i) {
    if ((of.motion.response.stances[at(of.frame)].standing >> i & 1U) == 0) continue;
    const Leg& leg = of.legs[i];
    const Rigid world_from_sole = world_from_socket(of.character, of.world, leg.sole);
    for (const double x : {leg.low_m.x, leg.high_m.x})
      for (const double z : {leg.low_m.z, leg.high_m.z}) corners.push_back(world_from_sole * Vec3(x, 0.0, z));
  }
  return hull_from_above(std::move(corners));
}

// A fan of triangles around the origin, seen from above.
Triangles patch_of(std::span<const Vec3> corners) {
  Triangles patch;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (const Vec3& corner : {Vec3(0.0), corners[i], corners[(i + 1) % corners.size()]}) {
      patch.positions_m.push_back(corner);
      patch.normals.emplace_back(0, 1, 0);
    }
  }
  return patch;
}

}  // namespace

Vec3 lever_point_m(const Character& character, std::span<const Rigid> world, int joint) {
  const Vec3 origin_m = world[at(joint)].p_m;
  int last = joint;
  for (int next = only_child(character, last); next >= 0; next = only_child(character, last)) {
    if (glm::distance(world[at(next)].p_m, origin_m) > kOwnPlace_m) return world[at(next)].p_m;
    last = next;
  }
  return world[at(last)] * character.joints()[at(last)].center_of_mass_m;
}

void add_control_arrows(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes) {
  for (int j = 0; j < static_cast<int>(of.character.joints().size()); ++j) {
    const Joint& joint = of.character.joints()[at(j)];
    const Quat& turned = of.world[at(j)].q;
    const std::span<const double> own = control_of(of, j);
    switch (joint.kind) {
      case JointKind::root: add_pushing_arrow(of.world[0].p_m, Vec3(own[0], own[1], own[2]), list, meshes); break;
      case JointKind::hinge: add_turning_arrow(of, j, turned * (own[0] * joint.axis), list, meshes); break;
      case JointKind::ball: add_turning_arrow(of, j, turned * Vec3(own[0], own[1], own[2]), list, meshes); break;
      case JointKind::prismatic:
        add_pushing_arrow(lever_point_m(of.character, of.world, j), turned * (own[0] * joint.axis), list, meshes);
        break;
    }
  }
}

void add_impact_arrows(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes) {
  for (const ImpactMark& impact : of.motion.response.impacts) {
    const int since = of.frame - impact.frame;
    if (since < 0 || since > kImpactShown_s * of.motion.rate_hz) continue;
    const double size_N_s = glm::length(impact.impulse_N_s);
    const double length_m = std::clamp(kArrow_m_per_N_s * size_N_s, kShortestImpact_m, kLongestArrow_m);
    const Vec3 along = unit_or(impact.impulse_N_s, Vec3(0, 1, 0));
    if (size_N_s > 0.0) add_arrow(list, meshes, impact.point_m - length_m * along, along, length_m, kImpactColor);
  }
}

void add_balance_marks(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes) {
  const Stance& stance = of.motion.response.stances[at(of.frame)];
  if (stance.footing != Footing::standing || !is_placed(of)) return;
  std::vector<Vec3> corners = support_corners(of);
  if (corners.empty()) return;
  const Vec3 color = stance.margin_m >= 0.0 ? kBalancedColor : kUnbalancedColor;
  const Vec3 center_m =
      std::accumulate(corners.begin(), corners.end(), Vec3(0.0)) / static_cast<double>(corners.size());
  for (Vec3& corner : corners) corner -= center_m;
  add_shape(list, meshes, patch_of(corners),
            {.world_from_mesh = {kNoRotation, center_m + Vec3(0.0, kLifted_m, 0.0)},
             .color = color,
             .ghost = true,
             .mark = true});
  if (stance.margin_m >= -kFarOutside_m)
    add_shape(list, meshes, tessellate(Sphere{Vec3(0.0), kBallRadius_m}),
              {.world_from_mesh = {kNoRotation, stance.zmp_m}, .color = color, .mark = true});
}

void add_loads(std::span<const LoadDesc> loads, const Character& character, std::span<const Rigid> world,
               DrawList& list, std::vector<Triangles>& meshes) {
  for (const LoadDesc& load : loads) {
    const int found = character.find_socket(load.slot + "/" + load.socket);
    if (found < 0) continue;
    const Socket& socket = character.sockets()[at(found)];
    const Rigid world_from_box =
        world[at(socket.joint)] * socket.joint_from_socket * Rigid{kNoRotation, load.position_m};
    add_shape(list, meshes, tessellate(Box{Vec3(0.0), 0.5 * load.size_m, Vec3(0.0)}),
              {.world_from_mesh = world_from_box, .color = kLoadColor, .ghost = true, .mark = true});
  }
}

}  // namespace contort
