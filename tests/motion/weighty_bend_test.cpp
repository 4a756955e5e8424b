// Bends of figures with mass: calm, and over their feet.
#include "generator/motion/weighty_bend.h"

#include <gtest/gtest.h>

#include "model/core/detmath.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

const auto there_and_back = [](double progress) { return 0.5 - 0.5 * det::cos(2.0 * kPi * progress); };

double calm_depth(double down_m, double lean_rad, double takes_s, double ahead_m = 0.0) {
  const auto root_at = [&](double deepest, double progress) {
    const double share = deepest * there_and_back(progress);
    return Rigid{axis_angle(Vec3(1, 0, 0), share * lean_rad), Vec3(0.0, 1.0 - share * down_m, 0.0)};
  };
  return calm_bend({root_at, Vec3(0.0, 0.0, ahead_m), takes_s});
}

TEST(WeightyBend, HipsGoDownNoFurtherThanTimeAllows) {
  // The greatest acceleration of the whole way is 2 pi^2 D / T^2 = 23.7 m/s^2, of which 6 are calm.
  EXPECT_EQ(calm_depth(0.3, 0.0, 0.5), 6.0 / 24.0);
  EXPECT_EQ(calm_depth(0.3, 0.0, 5.0), 1.0);
}

TEST(WeightyBend, HipsLeanNoFurtherThanTimeAllows) {
  EXPECT_LT(calm_depth(0.0, 1.2, 0.5), 0.2);
  EXPECT_EQ(calm_depth(0.0, 1.2, 3.0), 1.0);
}

TEST(WeightyBend, ACentreOfMassAheadOfTheHipsRisesWhenTheyLean) {
  EXPECT_EQ(calm_depth(0.0, 0.5, 1.5), 1.0);
  EXPECT_LT(calm_depth(0.0, 0.5, 1.5, 2.0), 0.8);
}

struct LeaningHuman {
  GaitFrame frame_at(double share) const {
    GaitFrame frame;
    frame.root = stage.character->rest_root();
    frame.root.q = frame.root.q * axis_angle(Vec3(1, 0, 0), share * lean_rad);
    frame.root.p_m.y -= share * down_m;
    for (std::size_t i = 0; i < stage.legs.size(); ++i) {
      std::vector<Rigid> rest = world;
      frame.feet[i].world_from_sole = world_from_socket(*stage.character, rest, stage.legs[i].sole);
    }
    return frame;
  }

  Vec3 center_of_mass(const GaitFrame& frame) {
    std::vector<Rigid> placed(world.size());
    stand_bent(*stage.character, stage.legs, frame, world, placed, row);
    Vec3 moment(0.0);
    double mass_kg = 0.0;
    for (std::size_t j = 0; j < placed.size(); ++j) {
      const Joint& joint = stage.character->joints()[j];
      moment += joint.mass_kg * (placed[j] * joint.center_of_mass_m), mass_kg += joint.mass_kg;
    }
    return moment / mass_kg;
  }

  LeaningHuman() : row(stage.character->rest_coords().begin(), stage.character->rest_coords().end()) {
    forward_kinematics(*stage.character, stage.character->rest_root(), row, world);
  }

  // The shift for standing on these legs.
  Vec3 shift_m(std::span<const Leg> legs) {
    const auto at_share = [&](double share) { return frame_at(share); };
    std::vector<Rigid> scratch(world.size());
    std::vector<double> spare = row;
    return shift_over_feet_m(*stage.character, legs, {at_share, 2.0, kPi}, world, {scratch, spare}, row);
  }

  double lean_rad = 0.6;
  double down_m = 0.05;
  Stage stage = fixtures::stage_of({});
  std::vector<double> row;
  std::vector<Rigid> world = std::vector<Rigid>(stage.character->joints().size());
};

TEST(WeightyBend, AFigureThatLeansForwardTakesItsHipsBack) {
  LeaningHuman human;
  const Vec3 shift_m = human.shift_m(human.stage.legs);
  const Vec3 stands_m = human.center_of_mass(human.frame_at(0.0));
  GaitFrame low = human.frame_at(1.0);
  EXPECT_GT(human.center_of_mass(low).z - stands_m.z, 0.05);
  low.root.p_m += shift_m;
  EXPECT_LT(shift_m.z, -0.05);
  EXPECT_EQ(shift_m.y, 0.0);
  EXPECT_LT(human.center_of_mass(low).z - stands_m.z, 0.08) << "well inside the soles";
}

// Ankles do not bend as far as a deep squat with a straight back asks: its heels rise.
TEST(WeightyBend, AFigureOnItsToesBalancesOverThem) {
  LeaningHuman human;
  human.lean_rad = 0.0, human.down_m = 0.4;
  GaitFrame low = human.frame_at(1.0);
  low.root.p_m += human.shift_m(human.stage.legs);
  const double center_m = human.center_of_mass(low).z;
  const Leg& leg = human.stage.legs.front();
  const double toes_m = low.feet[0].world_from_sole.p_m.z + leg.high_m.z;
  EXPECT_GT(center_m, toes_m - 0.06);
  EXPECT_LT(center_m, toes_m);
}

TEST(WeightyBend, AFigureWithoutLegsStaysWhereItIs) {
  LeaningHuman human;
  EXPECT_EQ(human.shift_m({}), Vec3(0.0));
}

}  // namespace
}  // namespace contort
