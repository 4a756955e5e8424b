#include "renders/contact_marks.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"

namespace contort {
namespace {

constexpr double kDot = 0.011;  // radii of dots, as fractions of the figure's size
constexpr double kLine = 0.005;
constexpr double kRim = 0.004;  // additional radius of the rim

Solid placed(const Character& character, std::span<const Rigid> world, int collider) {
  const Collider& own = character.colliders()[at(collider)];
  return moved(world[at(own.joint)], solid_of(own));
}

// Keeps the nearest, or deepest, of the pairs that it gets.
struct Nearest {
  std::optional<NearestPoints> found;
  void add(const Solid& a, const Solid& b) {
    const NearestPoints points = nearest_points(a, b);
    if (std::isfinite(points.distance_m) && (!found || points.distance_m < found->distance_m)) found = points;
  }
};

bool holds(const std::vector<int>& solid, int collider) {
  return std::find(solid.begin(), solid.end(), collider) != solid.end();
}

// Adds instances of the last mesh at each of the places.
void add_on_top(std::initializer_list<Vec3> places_m, const Vec3& color, DrawList& list,
                const std::vector<Triangles>& meshes) {
  for (const Vec3& place_m : places_m) {
    DrawInstance instance{static_cast<int>(meshes.size()) - 1, {kNoRotation, place_m}, color};
    instance.mark = true, instance.on_top = true;
    add_instance(list, instance);
  }
}

}  // namespace

std::optional<NearestPoints> contact_of_pair(const Character& character, const Highlight& highlight,
                                             std::span<const Rigid> world) {
  Nearest nearest;
  if (highlight.solids.size() != 2) return {};
  for (const ColliderPair& pair : character.judged_colliders())
    for (const auto& [a, b] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)})
      if (holds(highlight.solids[0], a) && holds(highlight.solids[1], b))
        nearest.add(placed(character, world, a), placed(character, world, b));
  return nearest.found;
}

std::optional<NearestPoints> contact_with_obstacle(const Character& character, const Environment& environment,
                                                   const Highlight& highlight, std::span<const Rigid> world) {
  Nearest nearest;
  if (highlight.solids.size() != 1) return {};
  for (const ObstacleDesc& obstacle : environment.obstacles())
    for (const int collider : highlight.solids.front())
      nearest.add(placed(character, world, collider),
                  moved(environment.world_from_environment(), solid_of(obstacle.shape)));
  return nearest.found;
}

void add_contact_mark(const NearestPoints& contact, double figure_m, DrawList& list, std::vector<Triangles>& meshes) {
  const Vec3 &a = contact.on_a_m, &b = contact.on_b_m;
  for (const double rim : {kRim, 0.0}) {  // later meshes are drawn over earlier ones
    const Vec3& color = rim > 0.0 ? kContactRimColor : kContactColor;
    meshes.push_back(tessellate(Capsule{Vec3(0.0), b - a, (kLine + rim) * figure_m}));
    add_on_top({a}, color, list, meshes);
    meshes.push_back(tessellate(Sphere{Vec3(0.0), (kDot + rim) * figure_m}));
    add_on_top({a, b}, color, list, meshes);
  }
}

}  // namespace contort
