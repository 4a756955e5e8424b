// Left and right in the names of failures.
#include "corpus/sides.h"

#include <gtest/gtest.h>

#include "tests/checks/family_text.h"

namespace contort {
namespace {

std::string other(const char* text) { return print_family(other_side(family(text))); }

TEST(Sides, AreExchangedInTheSubjectAlone) {
  EXPECT_EQ(other("joint_range|human|arm_left/elbow max"), "joint_range|human|arm_right/elbow max");
  EXPECT_EQ(other("joint_range|left_bot|arm_left/elbow max"), "joint_range|left_bot|arm_right/elbow max");
  EXPECT_EQ(other("balance|human|figure"), "balance|human|figure");
}

TEST(Sides, ArePartsOfNamesThatAreWords) {
  EXPECT_EQ(other("joint_range|x|upright/cleft right2 righteous"), "joint_range|x|upright/cleft left2 righteous");
}

TEST(Sides, OfPairsStandInOrderAgain) {
  EXPECT_EQ(other("self_collision|human|arm_left/hand ~ arm_right/forearm"),
            "self_collision|human|arm_left/forearm ~ arm_right/hand");
  EXPECT_EQ(other("self_collision|human|arm_left/hand ~ head"), "self_collision|human|arm_right/hand ~ head");
}

// The law that folding rests on.
TEST(Sides, ExchangedTwiceAreWhatTheyWere) {
  for (const char* text : {"pop|human|leg_left/knee", "self_collision|m|arm_left/a ~ leg_right/b", "x|y|z",
                           "self_collision|m|arm_left/a ~ arm_right/a", "crash|human|SIGSEGV"})
    EXPECT_EQ(other_side(other_side(family(text))), family(text));
}

Bucket bucket(const char* text, const char* features) {
  Bucket out;
  out.family = family(text), out.features = features;
  return out;
}

TEST(Sides, BucketsOfOneFaultStandTogetherInTheOrderOfTheirFirst) {
  const std::vector<Bucket> buckets = {bucket("pop|h|leg_right/knee", "actions=walk"), bucket("pop|h|waist", ""),
                                       bucket("pop|h|leg_left/knee", "actions=run"),
                                       bucket("pop|h|leg_left/knee", "actions=walk")};
  const std::vector<std::vector<std::size_t>> groups = {{0, 3}, {1}, {2}};
  EXPECT_EQ(without_sides(buckets), groups);
}

}  // namespace
}  // namespace contort
