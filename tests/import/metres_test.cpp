// Sizes and headings of models.
#include "import/metres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace contort {
namespace {

// A root in the middle and a bone on either side, `left` from it.
RiggedFigure figure_with_left_at(const Vec3& left) {
  RiggedFigure figure;
  figure.bones.resize(3);
  figure.bones[1].side = Side::left, figure.bones[1].position_m = left, figure.bones[1].parent = 0;
  figure.bones[2].side = Side::right, figure.bones[2].position_m = -left, figure.bones[2].parent = 0;
  return figure;
}

ModelBox cube(double side) {
  ModelBox box;
  box.add(Vec3(-0.5 * side)), box.add(Vec3(0.5 * side));
  return box;
}

RiggedFigure in_metres(const Vec3& left, double side, const ImportOptions& options = {}) {
  RiggedFigure figure = figure_with_left_at(left);
  const Result<Done> done = to_metres(figure, cube(side), options);
  EXPECT_TRUE(done) << to_line(done.issue());
  return figure;
}

TEST(Metres, TheLeftComesToPlusX) {
  for (const Vec3& left : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.9, 0.3, 0)}) {
    const RiggedFigure figure = in_metres(left, 2.0);
    EXPECT_NEAR(figure.bones[1].position_m.x, std::max(std::fabs(left.x), std::fabs(left.z)), 1e-5);
    EXPECT_EQ(figure.notes.empty(), left.x > 0.0) << "a turn is told";
  }
}

TEST(Metres, WithoutSidesNothingTurns) {
  const RiggedFigure figure = in_metres(Vec3(0.0), 2.0);
  EXPECT_EQ(figure.world_from_model, kNoRotation);
  EXPECT_EQ(figure.notes.size(), 1u);
}

TEST(Metres, GuessesPowersOfTenForSizesThatAreNoMetres) {
  EXPECT_EQ(in_metres(Vec3(1, 0, 0), 25.0).metres_per_unit, 1.0) << "a large animal";
  EXPECT_NEAR(in_metres(Vec3(1, 0, 0), 180.0).metres_per_unit, 0.01, 1e-15) << "centimetres";
  EXPECT_NEAR(in_metres(Vec3(0.001, 0, 0), 0.018).metres_per_unit, 100.0, 1e-12);
}

TEST(Metres, OptionsGoBeforeGuesses) {
  EXPECT_EQ(in_metres(Vec3(1, 0, 0), 180.0, {.name = "", .metres_per_unit = 0.5}).height_m, 90.0);
  EXPECT_NEAR(in_metres(Vec3(1, 0, 0), 180.0, {.name = "", .height_m = 1.8}).metres_per_unit, 0.01, 1e-15);
}

TEST(Metres, PlacesAreFromTheRootAndTheGroundIsTheLowestVertex) {
  RiggedFigure figure = figure_with_left_at(Vec3(1, 0, 0));
  for (Bone& bone : figure.bones) bone.position_m.y += 0.25;
  ASSERT_TRUE(to_metres(figure, cube(2.0), {}));
  EXPECT_EQ(figure.bones[0].position_m, Vec3(0.0));
  EXPECT_EQ(figure.bones[1].position_m, Vec3(1, 0, 0));
  EXPECT_EQ(figure.ground_m, -1.25);
}

TEST(Metres, RefusesWhatIsFlatOrTooLarge) {
  const auto code = [](double side, const Vec3& left, const ImportOptions& options) {
    RiggedFigure figure = figure_with_left_at(left);
    const Result<Done> done = to_metres(figure, cube(side), options);
    return done ? "" : done.issue().code;
  };
  EXPECT_EQ(code(0.0, Vec3(1, 0, 0), {}), "import.flat");
  EXPECT_EQ(code(2.0, Vec3(1, 0, 0), {.name = "", .metres_per_unit = 46.0}), "import.too_large");
  EXPECT_EQ(code(2.0, Vec3(91, 0, 0), {}), "import.too_large");
}

}  // namespace
}  // namespace contort
