// The stock quadruped: an animal that shares no part, slot or name of a limb with the people.
#include <gtest/gtest.h>

#include <set>

#include "model/motion/legs.h"
#include "tests/character/standing.h"

namespace contort {
namespace {

using fixtures::built;
using fixtures::joint;

CharacterChoice quadruped_choice(std::map<std::string, std::string> parts = {}) { return {"quadruped", parts, {}}; }

const Character& quadruped() {
  static const Character character = built(quadruped_choice());
  return character;
}

double mass_kg(const Character& character) {
  double sum = 0.0;
  for (const Joint& j : character.joints()) sum += j.mass_kg;
  return sum;
}

TEST(Quadruped, EveryCombinationStandsFreeAndHasNoFindings) {
  const CharacterDesc& desc = stock_library().characters.at("quadruped");
  const auto choices = fixtures::all_combinations(desc);
  EXPECT_EQ(choices.size(), 4U);
  for (CharacterChoice choice : choices) {
    fixtures::expect_stands_free(choice);
    fixtures::expect_no_findings_at_rest(choice);
    choice.attachments = {{"backpack", "trunk", "back"}};
    fixtures::expect_stands_free(choice);
  }
}

TEST(Quadruped, WeighsAsMuchAsALargeDog) { EXPECT_NEAR(mass_kg(quadruped()), 34.5, 0.1); }

TEST(Quadruped, StandsOnFourLegsInTwoRows) {
  const std::vector<Leg> legs = find_legs(quadruped());
  ASSERT_EQ(legs.size(), 4U);
  std::set<std::pair<int, int>> places;
  for (const Leg& leg : legs) {
    places.insert({leg.row, leg.side});
    EXPECT_NEAR(leg.home_m.y, 0.0, 1e-9) << quadruped().parts()[static_cast<std::size_t>(leg.part)].slot;
    EXPECT_TRUE(leg.has_ankle_pair);
  }
  EXPECT_EQ(places, (std::set<std::pair<int, int>>{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
}

// The displacement of the watched joint when the turned one turns by 0.2 rad.
Vec3 moved_m(const std::string& turned, const std::string& watched) {
  const Character& c = quadruped();
  std::vector<double> row(c.rest_coords().begin(), c.rest_coords().end());
  row[static_cast<std::size_t>(joint(c, turned).coord)] = 0.2;
  std::vector<Rigid> world(c.joints().size());
  forward_kinematics(c, c.rest_root(), row, world);
  const auto at = static_cast<std::size_t>(c.find_joint(watched));
  return world[at].p_m - fixtures::world_at_rest(c)[at].p_m;
}

// Flexing folds a leg: stifle and shoulder move the next link back; hock, elbow and hip move it forward.
TEST(Quadruped, PositiveAnglesFoldTheLegs) {
  EXPECT_GT(moved_m("leg_hind_left/hip_flex", "leg_hind_left/stifle").z, 0.02);
  EXPECT_LT(moved_m("leg_hind_left/stifle", "leg_hind_left/hock").z, -0.02);
  EXPECT_GT(moved_m("leg_hind_right/hock", "leg_hind_right/paw_flex").z, 0.02);
  EXPECT_LT(moved_m("leg_fore_left/shoulder_flex", "leg_fore_left/elbow").z, -0.02);
  EXPECT_GT(moved_m("leg_fore_right/elbow", "leg_fore_right/carpus").z, 0.02);
  EXPECT_LT(moved_m("leg_fore_left/carpus", "leg_fore_left/paw_flex").z, -0.01);
}

// Angles between bones in dogs by goniometry (Jaegger, Marcellin-Little & Levine 2002): the least and the greatest that
// the range of the part allows.
TEST(Quadruped, RangesAreThoseMeasuredOnDogs) {
  struct Measured {
    const char* joint;
    double flexed_deg;
    double extended_deg;
  };
  // The angle at rest follows from the bones' directions.
  const auto angle_at_rest_deg = [](const std::string& above, const std::string& at, const std::string& below) {
    const std::vector<Rigid> world = fixtures::world_at_rest(quadruped());
    const auto place = [&](const std::string& name) {
      return world[static_cast<std::size_t>(quadruped().find_joint(name))].p_m;
    };
    const Vec3 up = unit_or(place(above) - place(at), Vec3(0.0)), down = unit_or(place(below) - place(at), Vec3(0.0));
    return std::acos(glm::dot(up, down)) / kRadPerDeg;
  };
  const auto expect_range = [&](const std::string& leg, const char* above, const Measured& m, const char* below) {
    const Joint& j = joint(quadruped(), leg + m.joint);
    const double rest_deg = angle_at_rest_deg(leg + above, leg + m.joint, leg + below);
    EXPECT_NEAR(rest_deg - j.high / kRadPerDeg, m.flexed_deg, 2.0) << m.joint;
    EXPECT_NEAR(rest_deg - j.low / kRadPerDeg, m.extended_deg, 2.0) << m.joint;
  };
  expect_range("leg_hind_left/", "hip_flex", {"stifle", 42.0, 162.0}, "hock");
  expect_range("leg_hind_left/", "stifle", {"hock", 39.0, 164.0}, "paw_flex");
  expect_range("leg_fore_left/", "shoulder_flex", {"elbow", 36.0, 165.0}, "carpus");
  expect_range("leg_fore_left/", "elbow", {"carpus", 32.0, 196.0}, "paw_flex");
}

}  // namespace
}  // namespace contort
