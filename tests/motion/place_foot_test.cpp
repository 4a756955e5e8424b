// Feet on legs in postures that walks never take.
#include <gtest/gtest.h>

#include "generator/motion/place_foot.h"
#include "model/motion/kinematics.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

// The left leg of a character that stands here. Its sole is so far ahead of the hip that the leg is level, except for
// `drop_m`; the toes point along it.
std::vector<double> placed_level(const Character& character, const Rigid& world_from_start, double drop_m) {
  const Leg leg = find_legs(character).front();
  std::vector<double> row(character.rest_coords().begin(), character.rest_coords().end());
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, world_from_start * character.rest_root(), row, world);
  const Vec3 ankle_m = leg.hip_m + Vec3(0.02, -drop_m, 0.8 * leg.length_m);
  place_foot(character, leg, world, world_from_start * Rigid{Quat(1, 0, 0, 0), ankle_m - leg.sole_from_ankle}, row);
  return row;
}

// It was placed by rounding there: the foot of a leg that lies level turns by far more than the leg does.
TEST(PlaceFoot, OfALegThatLiesLevelIsTheSameWhereverItStands) {
  const Rigid there{axis_angle(Vec3(0, 1, 0), 2.4), Vec3(3.7, 0.0, -12.4)};
  for (const char* name : {"human", "mech", "quadruped"}) {
    const Character character = fixtures::built({name, {}, {}});
    for (const double drop_m : {0.2, 0.02, 2e-3, 2e-4, 2e-5, -2e-5, -2e-4, -2e-3, -0.02, -0.2}) {
      const std::vector<double> here = placed_level(character, {}, drop_m);
      const std::vector<double> moved = placed_level(character, there, drop_m);
      for (std::size_t c = 0; c < here.size(); ++c)
        EXPECT_NEAR(moved[c], here[c], 1e-9) << name << " " << drop_m << " " << c;
    }
  }
}

}  // namespace
}  // namespace contort
