#include "renders/draw_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "model/character/library.h"
#include "model/motion/kinematics.h"

namespace contort {
namespace {

const Character& drawn_mech() {
  static const Character character = [] {
    CharacterChoice choice;
    choice.name = "mech";
    return build_character(choice, stock_library()).value();
  }();
  return character;
}

std::vector<Rigid> resting_world() {
  std::vector<Rigid> world(drawn_mech().joints().size());
  forward_kinematics(drawn_mech(), drawn_mech().rest_root(), drawn_mech().rest_coords(), world);
  return world;
}

Highlight pair_of(const char* a, const char* b) {
  return {{{drawn_mech().find_collider(a)}, {drawn_mech().find_collider(b)}}, {}};
}

std::ptrdiff_t highlighted_count(const Figure& figure) {
  return std::count_if(figure.pieces.begin(), figure.pieces.end(),
                       [](const FigurePiece& p) { return p.highlight > 0; });
}

TEST(Figure, HasTheMeshInItsOwnColoursWithoutHighlight) {
  const Figure figure = make_figure(drawn_mech(), {});
  ASSERT_EQ(figure.pieces.size(), drawn_mech().mesh().size());
  for (std::size_t i = 0; i < figure.pieces.size(); ++i)
    EXPECT_EQ(figure.pieces[i].color, drawn_mech().mesh()[i].color);
  EXPECT_EQ(highlighted_count(figure), 0);
}

TEST(Figure, IsRedNowhereButWhereItIsHighlighted) {
  const Figure figure = make_figure(drawn_mech(), pair_of("arm_left/forearm", "torso/chest"));
  EXPECT_GE(highlighted_count(figure), 2);
  for (const FigurePiece& piece : figure.pieces) {
    const bool red = piece.color.x > 0.5 && piece.color.y <= 0.2 && piece.color.z < 0.2;
    EXPECT_EQ(red, piece.highlight > 0);
  }
}

TEST(Figure, HasBothGroupsOfAPair) {
  const Figure figure = make_figure(drawn_mech(), pair_of("arm_left/forearm", "torso/chest"));
  for (const int group : {1, 2})
    EXPECT_TRUE(std::any_of(figure.pieces.begin(), figure.pieces.end(), [&](const FigurePiece& p) {
      return p.highlight == group && !p.ghost;
    })) << group;
}

TEST(Figure, MarksAHighlightedJoint) {
  const int elbow = drawn_mech().find_joint("arm_left/elbow");
  ASSERT_GE(elbow, 0);
  const Figure figure = make_figure(drawn_mech(), {{}, {elbow}});
  EXPECT_EQ(figure.pieces.size(), drawn_mech().mesh().size() + 1);
  EXPECT_EQ(figure.pieces.back().joint, elbow);
  EXPECT_GE(highlighted_count(figure), 2);
}

TEST(AddFigure, PlacesEveryPieceWithItsJoint) {
  const Figure figure = make_figure(drawn_mech(), {});
  const std::vector<Rigid> world = resting_world();
  DrawList list;
  add_figure(list, figure, world);
  ASSERT_EQ(list.instances.size(), figure.pieces.size());
  EXPECT_TRUE(list.complete);
  for (std::size_t i = 0; i < figure.pieces.size(); ++i)
    EXPECT_EQ(list.instances[i].world_from_mesh, world[static_cast<std::size_t>(figure.pieces[i].joint)]);
}

TEST(AddFigure, LeavesOutWhatIsNowhere) {
  const Figure figure = make_figure(drawn_mech(), {});
  using Limits = std::numeric_limits<double>;
  for (const double nowhere : {Limits::quiet_NaN(), Limits::infinity(), 1e12}) {
    std::vector<Rigid> world = resting_world();
    world[0].p_m.x = nowhere;
    DrawList list;
    add_figure(list, figure, world);
    EXPECT_FALSE(list.complete);
    EXPECT_LT(list.instances.size(), figure.pieces.size());
    EXPECT_FALSE(list.instances.empty());
  }
}

TEST(AddFigure, MakesGhostsPaleAndWithoutHighlight) {
  DrawList list;
  add_figure(list, make_figure(drawn_mech(), pair_of("arm_left/forearm", "torso/chest")), resting_world(), Look::ghost);
  for (const DrawInstance& instance : list.instances) {
    EXPECT_TRUE(instance.ghost);
    EXPECT_EQ(instance.highlight, 0);
  }
}

TEST(Outline, HoldsEveryVertex) {
  const Figure figure = make_figure(drawn_mech(), {});
  DrawList list;
  add_figure(list, figure, resting_world());
  Vec3 low(1e9), high(-1e9);
  for (const Vec3& corner : outline(list, figure.meshes)) low = glm::min(low, corner), high = glm::max(high, corner);
  for (const DrawInstance& instance : list.instances)
    for (const Vec3& p : figure.meshes[static_cast<std::size_t>(instance.mesh)].positions_m) {
      const Vec3 world = instance.world_from_mesh * p;
      EXPECT_EQ(glm::clamp(world, low - 1e-9, high + 1e-9), world);
    }
  EXPECT_GT(high.y, 1.0);
}

}  // namespace
}  // namespace contort
