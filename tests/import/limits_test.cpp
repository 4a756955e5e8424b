// Ranges from clips, judged by the check that will judge the figure.
#include "import/limits.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/stage_evaluator.h"
#include "tests/import/rigged_model.h"

namespace contort {
namespace {

using fixtures::imported;
using fixtures::part_in;

// One bone of a model in those poses, once a second.
Imported model_that_turns(const std::vector<fixtures::RiggedBone>& bones, int node, const std::vector<Quat>& poses) {
  fixtures::GlbBuilder b = fixtures::rigged(bones);
  std::vector<float> times, values;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    times.push_back(static_cast<float>(i));
    for (const double v : {poses[i].x, poses[i].y, poses[i].z, poses[i].w}) values.push_back(static_cast<float>(v));
  }
  b.root["animations"] = {{{"name", "turn"}}};
  b.add_channel(0, node, "rotation", b.add_scalars(times), b.add_vec4(values), "STEP");
  const Result<Imported> in = imported(b);
  EXPECT_TRUE(in.ok());
  return *in;
}

// A worm's second joint.
Imported worm_that_turns(const std::vector<Quat>& poses) { return model_that_turns(fixtures::worm(3), 2, poses); }

std::vector<Finding> judged(const Imported& in, const std::vector<Quat>& poses) {
  const Result<Character> character = fixtures::character_of(in);
  Motion motion;
  motion.coord_count = character->coord_count();
  const Joint& joint = character->joints()[static_cast<std::size_t>(character->find_joint("body/x1"))];
  for (const Quat& q : poses) {
    motion.coords.insert(motion.coords.end(), character->rest_coords().begin(), character->rest_coords().end());
    motion.root.push_back(character->rest_root());
    double* row = motion.coords.data() + motion.frame_count++ * motion.coord_count + joint.coord;
    row[0] = q.w, row[1] = q.x, row[2] = q.y, row[3] = q.z;
  }
  StageEvaluator evaluator;
  return evaluator.judge(*character, motion, "joint_range");
}

Quat drawn_turn() {
  const auto part = [] { return (*rc::gen::inRange(-1000, 1001)) / 1000.0; };
  const double x = part(), y = part(), z = part();
  return from_rotation_vector(Vec3(x, y, z));
}

RC_GTEST_PROP(ImportedLimits, HoldEveryPoseOfTheClipsThatTheyComeFrom, ()) {
  std::vector<Quat> poses;
  for (int i = 0; i < 5; ++i) poses.push_back(drawn_turn());
  const Imported in = worm_that_turns(poses);
  RC_PRE(in.cut.bones[1].limits.source == LimitSource::clips);
  poses.push_back(kNoRotation);
  RC_ASSERT(judged(in, poses).empty());
}

TEST(ImportedLimits, AreNotMuchWiderThanTheClips) {
  const auto bent = [](double deg) { return axis_angle(Vec3(1, 0, 0), deg * kRadPerDeg); };
  const Imported in = worm_that_turns({bent(0), bent(60), bent(30), bent(60)});
  EXPECT_TRUE(judged(in, {bent(60), bent(64.9), bent(-4.9)}).empty());  // 5 degrees, as 10 % of 30 each way are less
  EXPECT_FALSE(judged(in, {bent(66)}).empty());
  EXPECT_FALSE(judged(in, {bent(-6)}).empty());
  EXPECT_EQ(count_sources(in, LimitSource::clips), 1);
  EXPECT_EQ(count_sources(in, LimitSource::generic), 1);  // the third joint never moves
}

TEST(ImportedLimits, OfPeopleThatAreTooNarrowForTheOwnClipsAreCounted) {
  constexpr int kLeftForearm = 6;  // its node
  const auto bent = [](double deg) { return axis_angle(Vec3(0, 1, 0), -deg * kRadPerDeg); };
  EXPECT_EQ(count_too_narrow(model_that_turns(fixtures::person(), kLeftForearm, {bent(0), bent(90)})), 0);
  EXPECT_EQ(count_too_narrow(model_that_turns(fixtures::person(), kLeftForearm, {bent(0), bent(175)})), 1);
}

TEST(ImportedLimits, WithoutClipsAreGeneric) {
  const Result<Imported> in = imported(fixtures::rigged(fixtures::worm(3)));
  ASSERT_TRUE(in.ok());
  const JointDesc& joint = part_in(*in, "body")->joints[0];
  EXPECT_EQ(joint.type, JointType::ball);
  EXPECT_EQ(joint.swing_deg, (std::array<double, 2>{45.0, 45.0}));
  EXPECT_EQ(joint.max_speed_deg_s, 3000.0);
}

// Spread arms hang down, swing forward and back as the stock human's do.
TEST(ImportedLimits, ShouldersTakeThePosesOfPeopleFromAnyRestPose) {
  const Result<Imported> in = imported(fixtures::rigged(fixtures::person()));
  ASSERT_TRUE(in.ok());
  const Result<Character> character = fixtures::character_of(*in);
  const Joint& shoulder = character->joints()[static_cast<std::size_t>(character->find_joint("arm_left/shoulder"))];
  const auto judge = [&](const Quat& q) {
    Motion motion;
    motion.coord_count = character->coord_count();
    motion.frame_count = 1;
    motion.coords.assign(character->rest_coords().begin(), character->rest_coords().end());
    motion.root.push_back(character->rest_root());
    double* row = motion.coords.data() + shoulder.coord;
    row[0] = q.w, row[1] = q.x, row[2] = q.y, row[3] = q.z;
    StageEvaluator evaluator;
    return evaluator.judge(*character, motion, "joint_range").empty();
  };
  const Quat hanging = axis_angle(Vec3(0, 0, 1), -0.5 * kPi);
  const auto flexed = [&](double deg) { return axis_angle(Vec3(-1, 0, 0), deg * kRadPerDeg) * hanging; };
  EXPECT_TRUE(judge(kNoRotation));
  EXPECT_TRUE(judge(hanging));
  EXPECT_TRUE(judge(flexed(90)));
  EXPECT_TRUE(judge(flexed(170)));
  EXPECT_TRUE(judge(flexed(-55)));
  EXPECT_FALSE(judge(flexed(-80)));
}

}  // namespace
}  // namespace contort
