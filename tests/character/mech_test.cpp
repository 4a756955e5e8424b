// The stock mech, whose parts can be swapped: all parts and objects fit.
#include <gtest/gtest.h>

#include <set>

#include "tests/character/standing.h"

namespace contort {
namespace {

using fixtures::all_combinations;
using fixtures::built;
using fixtures::expect_no_findings_at_rest;
using fixtures::expect_stands_free;
using fixtures::world_at_rest;

const CharacterDesc& mech() { return stock_library().characters.at("mech"); }

std::size_t parts_of(const std::string& slot) {
  for (const SlotDesc& s : mech().slots)
    if (s.name == slot) return std::set<std::string>(s.parts.begin(), s.parts.end()).size();
  return 0;
}

TEST(Mech, OffersPartsToChooseFrom) {
  EXPECT_GE(mech().slots.size(), 7U);
  EXPECT_GE(parts_of("arm_left"), 3U);
  EXPECT_GE(parts_of("arm_right"), 3U);
  for (const char* slot : {"torso", "head", "leg_left", "leg_right"}) EXPECT_GE(parts_of(slot), 2U) << slot;
  EXPECT_EQ(all_combinations(mech()).size(), 288U);
}

// Smallest clearance measured: 37 mm, between a right forearm and the right hip.
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
  expect_no_findings_at_rest({});
  expect_no_findings_at_rest(fixtures::mech_choice());
  for (const SlotDesc& slot : mech().slots)
    for (const std::string& part : slot.parts) expect_no_findings_at_rest(fixtures::mech_choice({{slot.name, part}}));
}

TEST(Mech, PartsOfBothSidesMirrorEachOtherAtRest) {
  for (const std::string& arm : mech().slots[3].parts) {
    const Character character = built(fixtures::mech_choice({{"arm_left", arm}, {"arm_right", arm}}));
    const std::vector<Rigid> world = world_at_rest(character);
    const Part& left = character.parts()[static_cast<std::size_t>(character.find_part("arm_left"))];
    const Part& right = character.parts()[static_cast<std::size_t>(character.find_part("arm_right"))];
    ASSERT_EQ(left.joint_count, right.joint_count);
    for (int i = 0; i < left.joint_count; ++i) {
      const Rigid& l = world[static_cast<std::size_t>(left.first_joint + i)];
      const Rigid& r = world[static_cast<std::size_t>(right.first_joint + i)];
      EXPECT_LT(length(mirror_point(l.p_m) - r.p_m), 1e-12) << arm;
    }
  }
}

}  // namespace
}  // namespace contort
