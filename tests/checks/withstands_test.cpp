// The push that figures withstand grows with mass and support, unless their file declares it.
#include "checks/withstands.h"

#include <gtest/gtest.h>

#include "generator/built_in.h"

namespace contort {
namespace {

const Vec3 kForward(0.0, 0.0, 1.0), kBackward(0.0, 0.0, -1.0);

Character stock(const std::string& name, const Library& library = stock_library()) {
  return build_character({name, {}, {}}, library).value();
}

Motion resting(const Character& character, const Rigid& turn = {}) {
  Motion motion;
  motion.frame_count = 3, motion.coord_count = character.coord_count(), motion.rate_hz = 60.0;
  for (int frame = 0; frame < 3; ++frame) {
    motion.root.push_back(turn * character.rest_root());
    motion.coords.insert(motion.coords.end(), character.rest_coords().begin(), character.rest_coords().end());
  }
  return motion;
}

// 73 kg with the centre of mass about 1 m high, some 5 cm in front of the heels and some 20 cm behind the toes.
// Measured in the simulation without a step: 49 N s forward, 15 backward (docs/internals/dynamics.md).
TEST(Withstands, IsAsMuchAsAPersonsWeightAndSolesAllow) {
  const Character human = stock("human");
  const double forward = withstands_N_s(human, resting(human), 1, kForward);
  const double backward = withstands_N_s(human, resting(human), 1, kBackward);
  EXPECT_GT(forward, 25.0);
  EXPECT_LT(forward, 60.0);
  EXPECT_GT(backward, 8.0);
  EXPECT_LT(backward, 25.0);
}

TEST(Withstands, IsTheSameForAFigureThatFacesElsewhere) {
  const Character human = stock("human");
  const Rigid quarter{axis_angle(Vec3(0.0, 1.0, 0.0), 0.5 * kPi), Vec3(3.0, 0.0, -2.0)};
  EXPECT_NEAR(withstands_N_s(human, resting(human, quarter), 1, Vec3(1.0, 0.0, 0.0)),
              withstands_N_s(human, resting(human), 1, kForward), 1e-6);
}

TEST(Withstands, IsWhatTheFileOfTheCharacterSays) {
  Library library = stock_library();
  library.characters.at("human").withstands_N_s = 3.0;
  const Character human = stock("human", library);
  EXPECT_EQ(withstands_N_s(human, resting(human), 1, kForward), 3.0);
  EXPECT_NE(human.hash(), stock("human").hash());
}

TEST(Withstands, IsNothingWhereTheCentreOfMassIsOutsideOfTheSupport) {
  const Character human = stock("human");
  const Rigid leaning{axis_angle(Vec3(1.0, 0.0, 0.0), 0.4), Vec3(0.0)};
  EXPECT_EQ(withstands_N_s(human, resting(human, leaning), 1, kForward), 0.0);
}

TEST(Withstands, CountsTheHorizontalPartOfABlowAlone) {
  const Character human = stock("human");
  Motion motion = resting(human);
  const double push = withstands_N_s(human, motion, 1, kForward);
  motion.response.impacts = {{1, 1, {}, Vec3(0.0, 500.0, 0.9 * push)}};
  EXPECT_FALSE(overpowering_blow(human, motion));
  motion.response.impacts = {{1, 1, {}, Vec3(0.0, 500.0, 1.1 * push)}};
  ASSERT_TRUE(overpowering_blow(human, motion));
  EXPECT_EQ(overpowering_blow(human, motion)->frame, 1);
  EXPECT_EQ(first_overpowered_frame(human, motion), 1);
}

}  // namespace
}  // namespace contort
