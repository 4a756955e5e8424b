// self_collision: bodies pushed together by a known depth.
#include <gtest/gtest.h>

#include "tests/checks/small_character.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

constexpr double kCollisionStep = 1e-6;
const char* const kArms = "arm_left/slide ~ arm_right/slide";

// Both arms slide inward; the boxes' inner faces are 0.4 m apart at rest.
Motion pushed_together(const Character& character, double clearance_m) {
  Motion motion = small::at_rest(character);
  for (const char* joint : {"arm_left/slide", "arm_right/slide"})
    small::set(motion, 0, small::joint_of(character, joint), -0.5 * (0.4 - clearance_m));
  return motion;
}

double arm_clearance(const Character& character, double clearance_m) {
  return small::margin_of("self_collision", character, pushed_together(character, clearance_m), kArms);
}

Library with_capsules() {
  Library library = small::library();
  library.parts["small_arm"].colliders[0].shape = Capsule{{0, -0.2, 0}, {0, 0.2, 0}, 0.1};
  return library;
}

TEST(SelfCollision, BoxesTouchAtZeroAndCountTheirDepth) {
  const Character character = small::build();
  for (const double clearance : {0.05, kCollisionStep, -kCollisionStep, -0.03})
    EXPECT_NEAR(arm_clearance(character, clearance), clearance, 1e-12);
}

TEST(SelfCollision, CapsulesTouchAtZeroAndCountTheirDepth) {
  const Character character = small::build(with_capsules());
  for (const double clearance : {0.05, kCollisionStep, -kCollisionStep, -0.03})
    EXPECT_NEAR(arm_clearance(character, clearance), clearance, 1e-12);
}

TEST(SelfCollision, ABoxAndACapsuleTouchAtZero) {
  Library library = with_capsules();
  library.parts["box_arm"] = small::arm_part();
  library.parts["box_arm"].name = "box_arm";
  library.characters["small"].slots[1].parts = {"box_arm"};
  const Character character = small::build(library);
  for (const double clearance : {kCollisionStep, -kCollisionStep, -0.03})
    EXPECT_NEAR(arm_clearance(character, clearance), clearance, 1e-12);
}

TEST(SelfCollision, TheLeastOfABodysCollidersCounts) {
  Library library = small::library();  // a nose that sticks out by 0.05 m on both arms
  library.parts["small_arm"].colliders.push_back({"nose", "slide", Sphere{{-0.1, 0, 0}, 0.05}});
  library.parts["small_arm"].colliders.push_back({"far", "slide", Sphere{{0.1, 0, 0}, 0.02}});
  EXPECT_NEAR(arm_clearance(small::build(library), 0.06), -0.04, 1e-12);
}

TEST(SelfCollision, AFindingNamesBothBodiesAndItsDepthInTwoCentimetres) {
  const Character character = small::build();
  StageEvaluator evaluator;
  const std::vector<Finding> findings = evaluator.judge(character, pushed_together(character, -0.03));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].check, "self_collision");
  EXPECT_EQ(findings[0].subject, kArms);
  EXPECT_EQ(findings[0].unit, "m");
  EXPECT_NEAR(findings[0].depth, 1.5, 1e-9);
}

TEST(SelfCollision, AnAttachedObjectCounts) {
  CharacterChoice choice{"small", {}, {{"peg", "arm_left", "inside"}}};
  const Character character = small::build(small::library(), choice);
  for (const double clearance : {kCollisionStep, -kCollisionStep}) {  // the peg reaches 0.1 m beyond the box
    const Motion motion = pushed_together(character, 0.1 + clearance);
    EXPECT_NEAR(small::margin_of("self_collision", character, motion, "arm_right/slide ~ object:peg"), clearance,
                1e-12);
  }
}

TEST(SelfCollision, AnAttachedObjectIsPartOfItsCarrier) {
  CharacterChoice choice{"small", {}, {{"peg", "arm_left", "inside"}}};
  for (const std::string& subject : small::subjects_of("self_collision", small::build(small::library(), choice)))
    EXPECT_NE(subject, "arm_left/slide ~ object:peg");
}

TEST(SelfCollision, AnAllowedPairIsSilent) {
  Library library = small::library();
  library.characters["small"].allowed_pairs = {{"arm_left/box", "arm_right/box", "They are bumpers."}};
  const Character character = small::build(library);
  StageEvaluator evaluator;
  EXPECT_TRUE(evaluator.judge(character, pushed_together(character, -0.03)).empty());
}

TEST(SelfCollision, AnAllowedPairSilencesNoOtherColliderOfTheBody) {
  Library library = small::library();
  library.parts["small_arm"].colliders.push_back({"nose", "slide", Sphere{{-0.1, 0, 0}, 0.05}});
  library.characters["small"].allowed_pairs = {{"arm_left/box", "arm_right/box", "They are bumpers."}};
  const Character character = small::build(library);
  EXPECT_NEAR(arm_clearance(character, 0.08), -0.02, 1e-12);
}

TEST(SelfCollision, NeighboursAreSilent) {  // the slider runs into the base that carries it
  const Character character = small::build();
  Motion motion = small::at_rest(character);
  small::set(motion, 0, small::joint_of(character, "arm_left/slide"), -0.3);
  StageEvaluator evaluator;
  EXPECT_TRUE(evaluator.judge(character, motion, "self_collision").empty());
}

TEST(SelfCollision, WhatIsFartherApartThanTheBandIsNotReported) {
  const Character character = small::build();
  EXPECT_NEAR(arm_clearance(character, 0.1 - kCollisionStep), 0.1 - kCollisionStep, 1e-12);
  EXPECT_EQ(arm_clearance(character, 0.1 + kCollisionStep), std::numeric_limits<double>::infinity());
}

TEST(SelfCollision, DoesNotDependOnWhereTheRootStands) {
  const Character character = small::build();
  Motion motion = pushed_together(character, -0.03);
  motion.root[0] = {from_rotation_vector({0.3, 2.0, -1.0}), {100.0, -50.0, 7.0}};
  EXPECT_NEAR(small::margin_of("self_collision", character, motion, kArms), -0.03, 1e-12);  // measured: 2e-15
}

TEST(SelfCollision, APlaceThatIsNoPlaceIsAFindingWithNaN) {
  const Character character = small::build();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Motion motion = small::at_rest(character);
    small::set(motion, 0, small::joint_of(character, "arm_left/slide"), bad);
    StageEvaluator evaluator;
    const std::vector<Finding> findings = evaluator.judge(character, motion, "self_collision");
    ASSERT_EQ(findings.size(), 1U) << bad;
    EXPECT_TRUE(std::isnan(findings[0].worst_margin)) << bad;
  }
}

}  // namespace

}  // namespace contort
