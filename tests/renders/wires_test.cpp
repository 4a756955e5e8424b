#include "renders/wires.h"

#include <gtest/gtest.h>

#include "model/character/library.h"
#include "model/geometry/distance.h"
#include "renders/shots.h"

namespace contort {
namespace {

constexpr double kRadius_m = 0.002;

double farthest_from_surface_m(const ColliderShape& shape) {
  double farthest = 0.0;
  for (const Vec3& p : wire_triangles(shape, kRadius_m).positions_m)
    farthest = std::max(farthest, std::fabs(signed_distance(solid_of(Sphere{p, 0.0}), solid_of(shape), 1e9)));
  return farthest;
}

TEST(Wires, LieOnTheirShapes) {
  EXPECT_LT(farthest_from_surface_m(Sphere{{1, 2, 3}, 0.1}), 2 * kRadius_m);
  EXPECT_LT(farthest_from_surface_m(Capsule{{1, 2, 3}, {1.2, 2.5, 3.1}, 0.1}), 2 * kRadius_m);
  EXPECT_LT(farthest_from_surface_m(Capsule{{1, 2, 3}, {1, 2, 3}, 0.1}), 2 * kRadius_m);
  EXPECT_LT(farthest_from_surface_m(Box{{1, 2, 3}, {0.1, 0.2, 0.3}, {10, 20, 30}}), 2 * kRadius_m);
  EXPECT_LT(farthest_from_surface_m(ConvexHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}), 2 * kRadius_m);
}

TEST(Wires, AreTheTwelveEdgesOfABox) {
  EXPECT_EQ(wire_triangles(Box{{}, {0.1, 0.2, 0.3}, {}}, kRadius_m).positions_m.size(), 12U * 3 * 6);
  EXPECT_EQ(wire_triangles(ConvexHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, kRadius_m).positions_m.size(),
            6U * 3 * 6);
}

TEST(Wires, AreAroundEveryColliderOfAFigureThatAsksForThem) {
  const Character human = build_character(CharacterChoice{}, stock_library()).value();
  Motion motion;
  motion.frame_count = 1, motion.coord_count = human.coord_count();
  motion.root = {human.rest_root()};
  motion.coords.assign(human.rest_coords().begin(), human.rest_coords().end());
  for (const bool wanted : {false, true}) {
    const Shots shots =
        take_shots({.character = human, .motion = motion, .ghost = &motion, .colliders = wanted}, std::vector<int>{0});
    std::size_t wires = 0;
    for (const DrawInstance& instance : shots.lists.front().instances)
      if (instance.color == kWireColor && instance.mark && !instance.ghost) ++wires;
    EXPECT_EQ(wires, wanted ? human.colliders().size() : 0U) << "of the figure, and not of its ghost";
  }
}

}  // namespace
}  // namespace contort
