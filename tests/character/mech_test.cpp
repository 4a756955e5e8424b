// The stock mech, whose parts can be swapped: everything that may stand on it fits.
#include <gtest/gtest.h>

#include <set>

#include "checks/distance.h"
#include "checks/evaluate.h"
#include "generator/motion/kinematics.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

using testing::all_combinations;
using testing::built;

const CharacterDesc& mech() { return stock_library().characters.at("mech"); }

std::size_t parts_of(const std::string& slot) {
  for (const SlotDesc& s : mech().slots)
    if (s.name == slot) return std::set<std::string>(s.parts.begin(), s.parts.end()).size();
  return 0;
}

std::vector<Rigid> world_at_rest(const Character& character) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  return world;
}

// The closest judged pair at rest, and its name.
std::pair<double, std::string> clearance(const Character& character) {
  const std::vector<Rigid> world = world_at_rest(character);
  const auto solid = [&](int c) {
    const Collider& collider = character.colliders()[static_cast<std::size_t>(c)];
    return moved(world[static_cast<std::size_t>(collider.joint)], solid_of(collider.shape));
  };
  std::pair<double, std::string> least{1e9, ""};
  for (const ColliderPair& pair : character.judged_colliders()) {
    const double distance_m = signed_distance(solid(pair.a), solid(pair.b), 0.1);
    const std::string name = character.colliders()[static_cast<std::size_t>(pair.a)].name + " " +
                             character.colliders()[static_cast<std::size_t>(pair.b)].name;
    least = std::min(least, {distance_m, name});
  }
  return least;
}

struct LowestPoint {
  const Rigid& world;
  double operator()(const Sphere& s) const { return (world * s.center_m).y - s.radius_m; }
  double operator()(const Capsule& c) const { return std::min((world * c.a_m).y, (world * c.b_m).y) - c.radius_m; }
  double operator()(const Box& b) const {
    double low = 1e9;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Quat q = from_rotation_vector(b.rotation_deg * kRadPerDeg);
      low = std::min(low, (world * (b.center_m + q * (side * b.half_m))).y);
    }
    return low;
  }
};

double lowest_point(const Character& character) {
  const std::vector<Rigid> world = world_at_rest(character);
  double low = 1e9;
  for (const Collider& c : character.colliders())
    low = std::min(low, std::visit(LowestPoint{world[static_cast<std::size_t>(c.joint)]}, c.shape));
  return low;
}

std::string text_of(const CharacterChoice& choice) {
  std::string text = choice.attachments.empty() ? "" : "rifle on " + choice.attachments[0].slot;
  for (const auto& [slot, part] : choice.parts) text += " " + slot + "=" + part;
  return text;
}

// Smallest clearance measured of a mech at rest: 37 mm, between a right forearm and the right hip.
void expect_stands_free(const CharacterChoice& choice) {
  const Result<Character> character = build_character(choice, stock_library());
  ASSERT_TRUE(character.ok()) << text_of(choice) << ": " << to_line(character.issue());
  const auto [distance_m, pair] = clearance(*character);
  EXPECT_GT(distance_m, 0.0) << text_of(choice) << ": " << pair;
  EXPECT_NEAR(lowest_point(*character), 0.0, 1e-12) << text_of(choice);
}

TEST(Mech, OffersPartsToChooseFrom) {
  EXPECT_GE(mech().slots.size(), 7U);
  EXPECT_GE(parts_of("arm_left"), 3U);
  EXPECT_GE(parts_of("arm_right"), 3U);
  for (const char* slot : {"torso", "head", "leg_left", "leg_right"}) EXPECT_GE(parts_of(slot), 2U) << slot;
  EXPECT_EQ(all_combinations(mech()).size(), 288U);
}

TEST(Mech, EveryCombinationStandsFree) {
  for (const CharacterChoice& choice : all_combinations(mech())) expect_stands_free(choice);
}

TEST(Mech, EveryCombinationStandsFreeWithARifle) {
  for (const char* arm : {"arm_left", "arm_right"})
    for (CharacterChoice choice : all_combinations(mech())) {
      choice.attachments = {{"rifle", arm, "grip"}};
      expect_stands_free(choice);
    }
}

TEST(Mech, HumansStandFreeWithWhatTheyCarry) {
  for (const char* hand : {"", "hand_left", "hand_right"})
    for (const bool pack : {false, true}) {
      CharacterChoice choice;
      if (hand[0] != '\0') choice.attachments.push_back({"rifle", hand, "grip"});
      if (pack) choice.attachments.push_back({"backpack", "torso", "back"});
      expect_stands_free(choice);
    }
}

// The checks of the product agree that rest is no fault, for every character and part.
TEST(Mech, RestHasNoFindings) {
  std::vector<CharacterChoice> choices = {{}, testing::mech_choice()};
  for (const SlotDesc& slot : mech().slots)
    for (const std::string& part : slot.parts) choices.push_back(testing::mech_choice({{slot.name, part}}));
  Evaluator evaluator;
  for (const CharacterChoice& choice : choices) {
    Spec spec;
    spec.character = choice;
    const Result<Stage> stage = build_stage(spec, stock_library());
    ASSERT_TRUE(stage.ok());
    for (const Finding& finding : evaluator.run(*stage).findings) ADD_FAILURE() << text_of(choice) << finding.subject;
  }
}

TEST(Mech, PartsOfBothSidesMirrorEachOtherAtRest) {
  for (const std::string& arm : mech().slots[3].parts) {
    const Character character = built(testing::mech_choice({{"arm_left", arm}, {"arm_right", arm}}));
    const std::vector<Rigid> world = world_at_rest(character);
    const Part& left = character.parts()[static_cast<std::size_t>(character.find_part("arm_left"))];
    const Part& right = character.parts()[static_cast<std::size_t>(character.find_part("arm_right"))];
    ASSERT_EQ(left.joint_count, right.joint_count);
    for (int i = 0; i < left.joint_count; ++i) {
      const Rigid& l = world[static_cast<std::size_t>(left.first_joint + i)];
      const Rigid& r = world[static_cast<std::size_t>(right.first_joint + i)];
      EXPECT_LT(testing::length(mirror_point(l.p_m) - r.p_m), 1e-12) << arm;
    }
  }
}

}  // namespace
}  // namespace contort
