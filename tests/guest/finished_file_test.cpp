// Finished animation files as motions of a character.
#include "guest/finished_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "checks/judge.h"
#include "formats/gltf/read.h"
#include "formats/gltf/write.h"
#include "guest/on_the_spot.h"
#include "tests/character/stock.h"
#include "tests/checks/small_character.h"
#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

using Joints = std::map<std::string, std::string>;
using Keys = std::vector<double>;

AssetChannel turning(int node, const Vec3& axis, const Keys& times_s, const Keys& angles_rad) {
  AssetChannel channel;
  channel.node = node, channel.path = ChannelPath::rotation, channel.times_s = times_s;
  for (const double angle : angles_rad) {
    const Quat q = axis_angle(axis, angle);
    for (const double value : {q.x, q.y, q.z, q.w}) channel.values.push_back(value);
  }
  return channel;
}

Keys evenly(std::size_t count, double step_s) {
  Keys times;
  for (std::size_t i = 0; i < count; ++i)  // as in files
    times.push_back(static_cast<double>(static_cast<float>(static_cast<double>(i) * step_s)));
  return times;
}

// A model with a node for the base, the slide and the lift of the small character's left arm, and one without a joint.
struct Model {
  Asset asset;
  std::shared_ptr<const Character> character = std::make_shared<const Character>(small::build());
  Joints joints = {{"Base", "root"}, {"Slide", "arm_left/slide"}, {"Lift", "arm_left/lift"}};

  explicit Model(const std::vector<AssetChannel>& channels) {
    const auto add = [&](const char* name, int parent, const Vec3& place) {
      AssetNode node;
      node.name = node.label = name, node.parent = parent, node.rest.translation = place;
      asset.order.push_back(static_cast<int>(asset.nodes.size()));
      asset.nodes.push_back(node);
    };
    add("Base", -1, {0, 0, 0}), add("Slide", 0, {0.3, 0, 0}), add("Lift", 1, {0.2, 0, 0}), add("Plume", 0, {0, 1, 0});
    AssetClip clip;
    clip.name = clip.label = "wave", clip.channels = channels;
    for (const AssetChannel& channel : channels) clip.last_s = std::max(clip.last_s, channel.times_s.back());
    asset.clips = {clip};
  }
  Result<Conversion> converted(double rate_hz = 0.0) const {
    return convert({asset, asset.clips[0], character, joints, rate_hz});
  }
};

const Vec3 kLiftAxis(0, 0, 1);

TEST(FinishedFile, AHingeThatTurnsByKeysHasTheirAnglesAsCoordinates) {
  const Keys angles = {0.0, 0.1, 0.25, -0.2, 0.4};
  const Model model({turning(2, kLiftAxis, evenly(5, 1.0 / 30.0), angles)});
  const Result<Conversion> made = model.converted();
  ASSERT_TRUE(made) << to_line(made.issue());
  const Motion& motion = made->execution.motion;
  EXPECT_NEAR(motion.rate_hz, 30.0, 1e-4);
  ASSERT_EQ(motion.frame_count, 5);
  const Joint& lift = small::joint_of(*model.character, "arm_left/lift");
  for (int f = 0; f < 5; ++f)
    EXPECT_NEAR(motion.row(f)[static_cast<std::size_t>(lift.coord)], angles[static_cast<std::size_t>(f)], 1e-5) << f;
  EXPECT_FALSE(made->execution.intent);
  EXPECT_EQ(made->execution.path, RootPath::told);
}

TEST(FinishedFile, APopBetweenTwoKeysIsSeen) {
  Keys angles(20, 0.0);
  angles[10] = 0.8;  // 24 rad/s; the joint may turn at 5.2
  const Model model({turning(2, kLiftAxis, evenly(20, 1.0 / 30.0), angles)});
  const Result<Conversion> made = model.converted();
  ASSERT_TRUE(made);
  const std::vector<Finding> findings = Judge().evaluate(made->execution, "pop").findings;
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].subject, "arm_left/lift");
  EXPECT_EQ(findings[0].first_frame, 10);
  EXPECT_EQ(findings[0].last_frame, 11);
}

TEST(FinishedFile, PastHalfATurnAHingeGoesOn) {
  Keys angles;
  for (int i = 0; i < 30; ++i) angles.push_back(0.25 * i);
  const Model model({turning(2, kLiftAxis, evenly(30, 1.0 / 30.0), angles)});
  const Result<Conversion> made = model.converted();
  ASSERT_TRUE(made);
  const Joint& lift = small::joint_of(*model.character, "arm_left/lift");
  EXPECT_NEAR(made->execution.motion.row(29)[static_cast<std::size_t>(lift.coord)], 7.25, 1e-6);
}

TEST(FinishedFile, WhatAJointCannotFollowIsSaid) {
  AssetChannel pulled;
  pulled.node = 2, pulled.times_s = {0.0, 1.0}, pulled.values = {0.2, 0, 0, 0.2, 0.05, 0};
  const Model model({turning(2, Vec3(1, 0, 0), {0.0, 0.5, 1.0}, {0.0, 0.3, 0.0}), pulled,
                     turning(3, kLiftAxis, {0.0, 1.0}, {0.0, 1.0})});
  const Result<Conversion> made = model.converted();
  ASSERT_TRUE(made);
  const int lift_joint = model.character->find_joint("arm_left/lift");
  const auto lift = std::ranges::find(made->followed, lift_joint, &FollowedNode::joint);
  ASSERT_NE(lift, made->followed.end());
  EXPECT_NEAR(lift->missed_rad, 0.3, 1e-9) << "it turns about z alone";
  EXPECT_EQ(lift->missed_frame, 15);
  EXPECT_GT(lift->moved_m, 0.0);
  EXPECT_EQ(made->stray_nodes, std::vector<int>{3});
  std::vector<std::string> at_rest;
  for (const int joint : made->joints_at_rest) at_rest.push_back(model.character->joint(joint).name);
  EXPECT_EQ(at_rest, (std::vector<std::string>{"arm_left/wrist", "arm_right/slide", "arm_right/lift",
                                               "arm_right/wrist"}));
}

TEST(FinishedFile, ItsRateLaysKeysOnFrames) {
  const auto rate = [](const Keys& times_s) {
    return own_rate_hz(Model({turning(2, kLiftAxis, times_s, Keys(times_s.size(), 0.0))}).asset.clips[0]);
  };
  EXPECT_NEAR(rate(evenly(300, 1.0 / 30.0)), 30.0, 1e-4) << "32-bit times do not drift";
  EXPECT_NEAR(rate(evenly(100, 1.0 / 24.0)), 48.0, 1e-4) << "at least 30";
  EXPECT_NEAR(rate({0.0, 0.5, 1.0}), 30.0, 1e-9) << "15 frames from key to key";
  EXPECT_NEAR(rate({0.0, 0.1, 0.15, 0.4}), 40.0, 1e-9) << "keys that were left out";
  EXPECT_NEAR(rate({0.0, 0.001, 1.0}), 30.0, 1e-9) << "two keys for one jump are no rate";
  EXPECT_EQ(rate({0.7}), 30.0);
  EXPECT_NEAR(Model({turning(2, kLiftAxis, {0.0, 1.0}, {0.0, 0.1})}).converted(100.0)->execution.motion.rate_hz, 100.0,
              1e-12);
}

TEST(FinishedFile, WithoutARootItStaysWhereItIsAndSaysSo) {
  Model model({turning(2, kLiftAxis, {0.0, 1.0}, {0.0, 0.3})});
  model.joints.erase("Base");
  const Result<Conversion> made = model.converted();
  ASSERT_TRUE(made) << to_line(made.issue());
  EXPECT_EQ(made->execution.path, RootPath::unknown);
  EXPECT_EQ(made->execution.motion.root.back(), model.character->rest_root());
}

TEST(FinishedFile, NothingThatMatchesIsAnErrorThatNamesWhatThereIs) {
  Model model({turning(2, kLiftAxis, {0.0, 1.0}, {0.0, 0.3})});
  model.joints = {{"node_of_another_file", "root"}};
  const Result<Conversion> made = model.converted();
  ASSERT_FALSE(made);
  EXPECT_EQ(made.issue().code, "check.nothing_matches");
  for (const char* name : {"Base", "Slide", "Plume", "arm_left/lift", "small"})
    EXPECT_NE(made.issue().text.find(name), std::string::npos) << name << ": " << made.issue().text;
}

TEST(FinishedFile, TooManyFramesAreRefused) {
  const Model model({turning(2, kLiftAxis, {0.0, 10000.0}, {0.0, 0.3})});
  EXPECT_EQ(model.converted().issue().code, "check.too_long");
  EXPECT_TRUE(model.converted(5.0)) << "at a lower rate it fits";
}

// The human, away from where models face.
TEST(FinishedFile, AModelThatFacesElsewhereIsTurned) {
  const TempFolder folder;
  const auto human = std::make_shared<const Character>(fixtures::human());
  Motion walk = small::at_rest(*human, 31, 30.0);
  for (int f = 0; f < 31; ++f) walk.root[static_cast<std::size_t>(f)].p_m.z += 0.02 * f;
  ASSERT_TRUE(save_glb(folder / "walk.glb", *human, walk, {}));
  Asset asset = *read_gltf(folder / "walk.glb");
  const Quat quarter = axis_angle(Vec3(0, 1, 0), 0.5 * kPi);
  for (AssetNode& node : asset.nodes)  // a parent that turns the model to +X
    if (node.parent < 0) node.parent = static_cast<int>(asset.nodes.size());
  AssetNode armature;
  armature.name = armature.label = "armature", armature.rest.rotation = quarter;
  asset.order.insert(asset.order.begin(), static_cast<int>(asset.nodes.size()));
  asset.nodes.push_back(armature);
  const Joints joints;
  const Result<Conversion> made = convert({asset, asset.clips[0], human, joints, 0.0});
  ASSERT_TRUE(made) << to_line(made.issue());
  const Vec3 way = made->execution.motion.root.back().p_m - made->execution.motion.root.front().p_m;
  EXPECT_LT(glm::length(way - Vec3(0, 0, 0.6)), 1e-5);
}

// Both ankles are pulled back repeatedly while the hips stay.
TEST(FinishedFile, AWalkOnTheSpotIsKnown) {
  const auto human = std::make_shared<const Character>(fixtures::human());
  const auto swinging = [&](double share) {
    Execution out;
    out.character = human, out.motion = small::at_rest(*human, 61, 30.0);
    for (int f = 0; f < 61; ++f)
      for (const double side : {1.0, -1.0}) {
        const std::string leg = side > 0 ? "leg_left/" : "leg_right/";
        const double phase = (f % 30) / 30.0 + (side > 0 ? 0.0 : 0.5), t = phase - std::floor(phase);
        const double forth = t < 0.5 ? 0.4 - 1.6 * t : -0.4 + 1.6 * (t - 0.5);
        small::set(out.motion, f, small::joint_of(*human, leg + "hip_flex"), share * forth);
        const double lift = t < 0.5 ? 0.0 : 16.0 * (t - 0.5) * (1.0 - t);
        small::set(out.motion, f, small::joint_of(*human, leg + "knee"), share * lift);
      }
    return out;
  };
  EXPECT_EQ(path_of(swinging(1.0)), RootPath::on_the_spot);
  EXPECT_EQ(path_of(swinging(0.1)), RootPath::told) << "feet that slide a little are a fault";
  Execution walks = swinging(1.0);
  for (int f = 0; f < 61; ++f) walks.motion.root[static_cast<std::size_t>(f)].p_m.z += 0.03 * f;
  EXPECT_EQ(path_of(walks), RootPath::told);
}

}  // namespace
}  // namespace contort
