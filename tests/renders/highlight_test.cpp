#include "renders/highlight.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/character/library.h"

namespace contort {
namespace {

const Character& highlighted_human() {
  static const Character character = [] {
    CharacterChoice choice;
    choice.attachments.push_back({"rifle", "hand_right", "grip"});
    return build_character(choice, stock_library()).value();
  }();
  return character;
}

Highlight highlight_of(const std::string& subject) {
  Finding finding;
  finding.subject = subject;
  return highlighted(highlighted_human(), finding);
}

std::vector<int> joints_of_group(const Highlight& highlight, int group) {
  const std::vector<int> groups = highlight_groups(highlighted_human(), highlight);
  std::vector<int> joints;
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (groups[i] == group) joints.push_back(highlighted_human().mesh()[i].joint);
  return joints;
}

TEST(Highlighted, UnderstandsPairsOfColliders) {
  const int forearm = highlighted_human().find_collider("arm_left/forearm"),
            chest = highlighted_human().find_collider("torso/chest");
  ASSERT_GE(forearm, 0);
  ASSERT_GE(chest, 0);
  const Highlight pair = highlight_of("arm_left/forearm ~ torso/chest");
  ASSERT_EQ(pair.solids.size(), 2u);
  EXPECT_NE(std::find(pair.solids[0].begin(), pair.solids[0].end(), forearm), pair.solids[0].end());
  EXPECT_EQ(pair.solids[1], std::vector<int>{chest});
  const int barrel = highlighted_human().find_collider("object:rifle/barrel");
  ASSERT_GE(barrel, 0);
  EXPECT_EQ(highlight_of("object:rifle/barrel ~ torso/chest").solids[0], std::vector<int>{barrel});
}

TEST(Highlighted, UnderstandsWhatIsJudged) {
  for (const JudgedPair& judged : highlighted_human().judged_pairs()) {
    const Body& a = highlighted_human().bodies()[static_cast<std::size_t>(judged.body_a)];
    const Body& b = highlighted_human().bodies()[static_cast<std::size_t>(judged.body_b)];
    const Highlight pair = highlight_of(a.name + " ~ " + b.name);
    ASSERT_EQ(pair.solids.size(), 2u) << a.name << " ~ " << b.name;
    EXPECT_EQ(pair.solids[0].size(), static_cast<std::size_t>(a.collider_count));
    EXPECT_EQ(pair.solids[1].front(), b.first_collider);
    const std::vector<int> groups = highlight_groups(highlighted_human(), pair);
    for (const int group : {1, 2}) EXPECT_GE(std::count(groups.begin(), groups.end(), group), 1) << a.name << b.name;
  }
}

TEST(Highlighted, UnderstandsEverySubjectOfEveryPairOfColliders) {
  for (const Collider& a : highlighted_human().colliders())
    for (const Collider& b : highlighted_human().colliders())
      ASSERT_EQ(highlight_of(a.name + " ~ " + b.name).solids.size(), 2u) << a.name << " ~ " << b.name;
}

TEST(Highlighted, UnderstandsJointsWithAndWithoutWords) {
  for (const Joint& joint : highlighted_human().joints()) {
    const Highlight wanted{{}, {highlighted_human().find_joint(joint.name)}};
    EXPECT_EQ(highlight_of(joint.name), wanted);
    EXPECT_EQ(highlight_of(joint.name + " max"), wanted);
    EXPECT_EQ(highlight_of(joint.name + " swing or so"), wanted);
  }
}

TEST(Highlighted, UnderstandsOtherNames) {
  EXPECT_EQ(highlight_of("torso/chest max").solids.size(), 1u);
  EXPECT_EQ(highlight_of("object:rifle").solids.size(), 1u);
  EXPECT_FALSE(highlight_of("hand_right/grip").empty());
  EXPECT_GE(highlight_of("arm_left").joints.size(), 2u);
}

TEST(Highlighted, HighlightsNothingForUnknownNames) {
  for (const char* subject : {"", " ", "~", " ~ ", "nothing ~ torso/chest", "nothing", "nothing max", "arm_left/elbo",
                              "arm_left/forearm~torso/chest"})
    EXPECT_TRUE(highlight_of(subject).empty()) << subject;
}

TEST(HighlightGroups, GivesBothOfAPairTheirPieces) {
  const Highlight highlight = highlight_of("arm_left/forearm ~ torso/chest");
  EXPECT_FALSE(joints_of_group(highlight, 1).empty());
  EXPECT_FALSE(joints_of_group(highlight, 2).empty());
  for (const int joint : joints_of_group(highlight, 1))
    EXPECT_EQ(joint, highlighted_human().find_joint("arm_left/elbow"));
}

TEST(HighlightGroups, KeepsAnObjectApartFromTheHandThatHoldsIt) {
  const Highlight highlight = highlight_of("object:rifle/barrel ~ hand_right/palm");
  const std::vector<int> groups = highlight_groups(highlighted_human(), highlight);
  EXPECT_GE(std::count(groups.begin(), groups.end(), 1), 1);
  EXPECT_GE(std::count(groups.begin(), groups.end(), 2), 1);
  EXPECT_GT(std::count(groups.begin(), groups.end(), 0), 20);
}

TEST(HighlightGroups, FindsAPieceForEveryJoint) {
  for (const Joint& joint : highlighted_human().joints()) {
    const std::vector<int> groups = highlight_groups(highlighted_human(), highlight_of(joint.name));
    EXPECT_GE(std::count(groups.begin(), groups.end(), 1), 1) << joint.name;
  }
}

TEST(HighlightGroups, AreEmptyWithoutHighlight) {
  const std::vector<int> groups = highlight_groups(highlighted_human(), {});
  EXPECT_EQ(std::count(groups.begin(), groups.end(), 0),
            static_cast<std::ptrdiff_t>(highlighted_human().mesh().size()));
}

}  // namespace
}  // namespace contort
