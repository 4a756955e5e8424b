// Contacts that nearly every posture has are proposed as no faults of a character.
#include "import/contacts.h"

#include "tests/checks/small_character.h"

namespace contort {
namespace {

constexpr int kPoses = 200;

// The boxes of the arms are 0.4 m apart at rest; sliders bring them 0.5 m nearer and 0.2 m farther apart.
Library with_box_at(double x_m) {
  Library library = small::library();
  library.parts["small_arm"].colliders[0].shape = Box{{x_m, 0, 0}, {0.1, 0.1, 0.1}, {}};
  return library;
}

AllowedPairDesc only_pair(const OwnContacts& contacts) {
  EXPECT_EQ(contacts.pairs.size(), 1U);
  return contacts.pairs.empty() ? AllowedPairDesc{} : contacts.pairs.front();
}

TEST(Contacts, NoneIsProposedOfAFigureThatCanHoldItselfApart) {
  const OwnContacts contacts = propose_contacts(small::build(), kPoses);
  EXPECT_EQ(contacts.pairs, std::vector<AllowedPairDesc>{});
  EXPECT_EQ(contacts.at_rest + contacts.in_poses, 0);
}

TEST(Contacts, AnOverlapOfTheRestPoseIsProposedWithItsDepth) {
  const OwnContacts contacts = propose_contacts(small::build(with_box_at(-0.21)), 0);
  EXPECT_EQ(contacts.at_rest, 1);
  EXPECT_EQ(only_pair(contacts),
            (AllowedPairDesc{"arm_left/box", "arm_right/box", "rest_pose: they overlap by 0.0200 m"}));
}

// The boxes are 0.02 m apart at rest, and as far in as their sliders go, 0.28 m in each other: one posture in a hundred
// is without.
TEST(Contacts, AnOverlapInNearlyAllPosturesIsProposedWithItsCount) {
  Library library = with_box_at(-0.19);
  for (JointDesc& joint : library.parts["small_arm"].joints)
    if (joint.name == "slide") joint.low_m = -0.15, joint.high_m = 0.0;
  const OwnContacts contacts = propose_contacts(small::build(library), kPoses);
  EXPECT_EQ(contacts.at_rest, 0);
  EXPECT_EQ(contacts.in_poses, 1);
  const std::string reason = only_pair(contacts).reason;
  EXPECT_TRUE(reason.starts_with("sampled_poses: they overlap in ")) << reason;
  EXPECT_TRUE(reason.ends_with(" of 200 poses within all ranges")) << reason;
}

// A third of the postures is without: then an overlap may well be a fault.
TEST(Contacts, AnOverlapInMostPosturesIsNotProposed) {
  Library library = with_box_at(-0.19);
  for (JointDesc& joint : library.parts["small_arm"].joints)
    if (joint.name == "slide") joint.low_m = -0.1, joint.high_m = 0.05;
  EXPECT_EQ(propose_contacts(small::build(library), kPoses).pairs, std::vector<AllowedPairDesc>{});
}

TEST(Contacts, WhatIsAllowedIsNotProposedAgain) {
  Library library = with_box_at(-0.21);
  library.characters["small"].allowed_pairs = propose_contacts(small::build(library), 0).pairs;
  EXPECT_EQ(propose_contacts(small::build(library), kPoses).pairs, std::vector<AllowedPairDesc>{});
}

TEST(Contacts, StockCharactersNeedNoMore) {
  for (const char* name : {"human", "mech", "quadruped"}) {
    const Character character = small::build(stock_library(), {name, {}, {}});
    EXPECT_EQ(propose_contacts(character, kPoses).pairs, std::vector<AllowedPairDesc>{}) << name;
  }
}

// The sampled postures are in range by the check of ranges, too.
TEST(Contacts, OverlapsAreCountedOnlyWhereJointsCanGo) {
  Library library = with_box_at(-0.19);
  for (JointDesc& joint : library.parts["small_arm"].joints)
    if (joint.name == "slide") joint.low_m = 0.0, joint.high_m = 0.1;  // never nearer than at rest
  EXPECT_EQ(propose_contacts(small::build(library), kPoses).pairs, std::vector<AllowedPairDesc>{});
}

}  // namespace
}  // namespace contort
