#include "renders/divergence.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "model/character/library.h"

namespace contort {
namespace {

const Character& diverging_human() {
  static const Character character = build_character(CharacterChoice{}, stock_library()).value();
  return character;
}

const Character& mech() {
  static const Character character = build_character({"mech", {}, {}}, stock_library()).value();
  return character;
}

Motion resting(const Character& character, int frames) {
  Motion motion;
  motion.frame_count = frames, motion.coord_count = character.coord_count();
  for (int f = 0; f < frames; ++f) {
    motion.root.push_back(character.rest_root());
    motion.coords.insert(motion.coords.end(), character.rest_coords().begin(), character.rest_coords().end());
  }
  return motion;
}

void turn(Motion& motion, int frame, const char* joint, double by_rad) {
  const int index = diverging_human().find_joint(joint);
  ASSERT_GE(index, 0);
  motion.row(frame)[static_cast<std::size_t>(diverging_human().joints()[static_cast<std::size_t>(index)].coord)] +=
      by_rad;
}

Divergence between(const Motion& a, const Motion& b, double tolerance_m = kSamePlace_m) {
  return find_divergence({diverging_human(), a}, {diverging_human(), b}, tolerance_m).value();
}

TEST(Divergence, IsNoneOfAMotionAndItself) {
  const Motion motion = resting(diverging_human(), 9);
  const Divergence divergence = between(motion, motion, 0.0);
  EXPECT_TRUE(divergence.none());
  EXPECT_EQ(divergence.frames, 9);
  EXPECT_EQ(divergence.joints, static_cast<int>(diverging_human().joints().size()));
  EXPECT_NE(divergence_text(divergence, 0.0, 60.0).find("no difference"), std::string::npos);
}

TEST(Divergence, IsTheFirstFrameAndTheJointFarthestOut) {
  const Motion a = resting(diverging_human(), 9);
  Motion b = a;
  turn(b, 3, "arm_left/elbow", 0.1);
  turn(b, 4, "arm_left/elbow", 0.5);
  turn(b, 6, "arm_left/elbow", 0.2);
  const Divergence divergence = between(a, b);
  EXPECT_EQ(divergence.first.frame, 3);
  EXPECT_EQ(divergence.worst.frame, 4);
  EXPECT_EQ(divergence.last_frame, 6);
  EXPECT_EQ(divergence.first.joint.rfind("hand_left/", 0), 0U) << divergence.first.joint;
  EXPECT_GT(divergence.first.apart_m, 0.02);
  EXPECT_GT(divergence.worst.apart_m, divergence.first.apart_m);
  EXPECT_FALSE(divergence.none());
  const std::string text = divergence_text(divergence, kSamePlace_m, 60.0);
  EXPECT_EQ(text.rfind("first difference at frame 3 (0.050 s): hand_left/", 0), 0U) << text;
  EXPECT_NE(text.find("to 1 mm"), std::string::npos) << text;
}

TEST(Divergence, IsThereOnlyBeyondTheTolerance) {
  const Motion a = resting(diverging_human(), 2);
  Motion b = a;
  b.root[1].p_m.x += 0.004;
  EXPECT_TRUE(between(a, b, 0.0041).none());
  EXPECT_EQ(between(a, b, 0.0039).first.frame, 1);
}

// The joint stays in place, but the bodies that it carries move.
TEST(Divergence, SeesWhatOnlyTurns) {
  const Motion a = resting(diverging_human(), 2);
  for (const Joint& joint : diverging_human().joints()) {
    if (joint.kind != JointKind::hinge || joint.name.rfind("hand_left/", 0) != 0) continue;
    Motion b = a;
    turn(b, 1, joint.name.c_str(), 0.5);
    EXPECT_EQ(between(a, b).first.frame, 1) << joint.name;
  }
}

TEST(Divergence, SeesThatOnlyOneHasAPlace) {
  const Motion a = resting(diverging_human(), 3);
  Motion b = a;
  b.root[2].p_m.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(between(a, b).first.frame, 2);
  EXPECT_TRUE(std::isnan(between(a, b).first.apart_m));
  EXPECT_TRUE(between(b, b).none()) << "both are nowhere";
  const auto json = nlohmann::json::parse(divergence_json(between(a, b), kSamePlace_m, 60.0));
  EXPECT_TRUE(json["first_difference"]["apart_m"].is_null());
  EXPECT_FALSE(json["same"].get<bool>());
}

TEST(Divergence, IsALengthToo) {
  const Divergence divergence = between(resting(diverging_human(), 5), resting(diverging_human(), 7));
  EXPECT_FALSE(divergence.none());
  EXPECT_EQ(divergence.first.frame, -1);
  EXPECT_NE(divergence_text(divergence, kSamePlace_m, 60.0).find("one has 5 frames, the other 7"), std::string::npos);
}

TEST(Divergence, OfOtherFiguresIsOfTheJointsThatBothHave) {
  const Motion a = resting(diverging_human(), 2), b = resting(mech(), 2);
  const Divergence divergence = find_divergence({diverging_human(), a}, {mech(), b}, kSamePlace_m).value();
  EXPECT_EQ(divergence.first.frame, 0);
  EXPECT_FALSE(divergence.only_a.empty());
  EXPECT_EQ(divergence.joints + static_cast<int>(divergence.only_a.size()),
            static_cast<int>(diverging_human().joints().size()));
  EXPECT_EQ(divergence.joints + static_cast<int>(divergence.only_b.size()), static_cast<int>(mech().joints().size()));
}

TEST(Divergence, IsNotFoundAtDifferentTimes) {
  const Motion a = resting(diverging_human(), 2);
  Motion b = a;
  b.rate_hz = 30.0;
  const Result<Divergence> divergence = find_divergence({diverging_human(), a}, {diverging_human(), b}, kSamePlace_m);
  ASSERT_FALSE(divergence.ok());
  EXPECT_EQ(divergence.issue().code, "compare.other_rate");
}

}  // namespace
}  // namespace contort
