// Animations made elsewhere as motions of a character.
#include "model/motion/recording.h"

#include "formats/gltf/write.h"
#include "generator/generate.h"
#include "generator/recordings.h"
#include "model/motion/kinematics.h"
#include "tests/character/stock.h"
#include "tests/corpus/temp_folder.h"
#include "tests/mocap/asf_text.h"
#include "tests/scenes.h"

namespace contort {
namespace {

using fixtures::human;
using fixtures::joint;

// A library with the motion of a spec as the animation "taken", and a spec that plays it.
struct Taken {
  Library library = stock_library();
  Spec spec;
  Motion original;
};

Taken taken(const Spec& made) {
  const TempFolder folder;
  Taken out;
  const Stage stage = *build_stage(made, out.library);
  out.original = generate(stage);
  EXPECT_TRUE(save_glb(folder / "taken.glb", *stage.character, out.original, {}));
  EXPECT_TRUE(load_recordings(folder.path(), out.library));
  out.spec.character = made.character, out.spec.rate_hz = made.rate_hz;
  out.spec.recording.name = "taken";
  return out;
}

TEST(Recording, AMotionOfOurOwnComesBackFromItsFile) {
  for (const char* name : {"mech_walk_aim", "quadruped_dynamic", "human_tracking"}) {
    Spec made = scene(name);
    made.dynamics = {};
    const Taken t = taken(made);
    const Motion again = generate(*build_stage(t.spec, t.library));
    ASSERT_EQ(again.frame_count, t.original.frame_count) << name;
    for (std::size_t i = 0; i < again.coords.size(); ++i)
      ASSERT_NEAR(again.coords[i], t.original.coords[i], 2e-6) << name << " " << i;
    for (std::size_t f = 0; f < again.root.size(); ++f)
      ASSERT_LT(glm::length(again.root[f].p_m - t.original.root[f].p_m), 1e-5) << name << " " << f;
  }
}

TEST(Recording, TheMapOfAnImportedCharacterAppliesIfTheSpecNamesNoNodes) {
  Taken t = taken(scene("human_tracking"));
  Asset renamed = *t.library.recordings.at("taken");
  std::map<std::string, std::string> map = {{"elsewhere", "head/neck_flex"}, {"Brow", "horn/joint"}};
  for (AssetNode& node : renamed.nodes) {
    map["node of " + node.name] = node.name;
    node.name = node.label = "node of " + node.name;
  }
  t.library.recordings["taken"] = std::make_shared<const Asset>(renamed);
  EXPECT_FALSE(build_stage(t.spec, t.library)) << "no joint has a node of its name";
  t.library.joint_maps["human"] = map;
  const Result<Stage> stage = build_stage(t.spec, t.library);
  ASSERT_TRUE(stage) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  for (std::size_t i = 0; i < motion.coords.size(); ++i)
    ASSERT_NEAR(motion.coords[i], t.original.coords[i], 2e-6) << i;
  t.spec.recording.joints = {{"node of root", "root"}, {"node of leg_left/knee", "leg_left/knee"}};
  const Result<Stage> named = build_stage(t.spec, t.library);
  ASSERT_TRUE(named) << to_line(named.issue());
  EXPECT_NE(generate(*named).coords, motion.coords) << "what the spec names is all that counts";
}

TEST(Recording, ItStartsWhereTheSpecSays) {
  Taken t = taken(scene("human_tracking"));
  t.spec.start.position_m = {3, 0, -2}, t.spec.start.heading_deg = 90.0;
  const Stage stage = *build_stage(t.spec, t.library);
  const Motion moved = generate(stage);
  for (std::size_t f = 0; f < moved.root.size(); ++f) {
    const Rigid wanted = stage.start * t.original.root[f];
    EXPECT_LT(glm::length(moved.root[f].p_m - wanted.p_m), 1e-5);
    EXPECT_LT(rotation_angle(glm::conjugate(moved.root[f].q) * wanted.q), 1e-5);
  }
}

TEST(Recording, WhatComesBeforeItsBeginningIsLeftOut) {
  Taken t = taken(scene("human_tracking"));
  t.spec.recording.from_s = 0.5;
  const Motion motion = generate(*build_stage(t.spec, t.library));
  ASSERT_EQ(motion.frame_count, t.original.frame_count - 30);
  for (int f = 0; f < motion.frame_count; ++f)
    EXPECT_LT(glm::length(motion.root[static_cast<std::size_t>(f)].p_m -
                          t.original.root[static_cast<std::size_t>(f) + 30].p_m),
              1e-5);
}

// BVH: the root rests at the origin, lengths are inches, and the ground is unknown.
TEST(Recording, AModelThatRestsAtTheOriginStandsOnItsLowestNode) {
  Asset asset;
  const auto add = [&](const char* name, int parent, const Vec3& position) {
    AssetNode node;
    node.name = node.label = name, node.parent = parent, node.rest.translation = position;
    asset.order.push_back(static_cast<int>(asset.nodes.size()));
    asset.nodes.push_back(node);
    return asset.order.back();
  };
  const int hips = add("Hips", -1, {0, 0, 0}), knee = add("Knee", add("Hip", hips, {4, -1, 0}), {0, -16, 0});
  add("Foot", knee, {0, -16, 0});
  AssetClip clip;
  clip.name = clip.label = "walk", clip.last_s = 1.0;
  AssetChannel path;
  path.path = ChannelPath::translation, path.times_s = {0.0, 1.0}, path.values = {0, 36, 0, 0, 37, 40};
  clip.channels = {path};
  asset.clips = {clip};
  const std::map<std::string, std::string> joints = {
      {"Hips", "root"}, {"Hip", "leg_left/hip_flex"}, {"Knee", "leg_left/knee"}, {"Foot", "foot_left/ankle_flex"}};
  const Character character = human();
  const Motion motion = *follow_recording(character, {asset, clip, joints, 0.0, 30.0, 0, {}});
  EXPECT_NEAR(motion.root[0].p_m.y, character.rest_root().p_m.y, 1e-9);
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  const auto foot = static_cast<std::size_t>(character.find_joint("foot_left/ankle_flex"));
  const double scale = (world[0].p_m.y - world[foot].p_m.y) / 33.0;
  EXPECT_NEAR(motion.root[30].p_m.y - motion.root[0].p_m.y, scale, 1e-9);
  EXPECT_NEAR(motion.root[30].p_m.z, 40.0 * scale, 1e-9);
}

TEST(Recording, DynamicsFollowsItAsItFollowsActions) {
  Spec squat = scene("human_dynamic");
  squat.dynamics = {};
  Taken t = taken(squat);
  t.spec.dynamics.mode = Mode::dynamic;
  const Motion motion = generate(*build_stage(t.spec, t.library));
  ASSERT_EQ(static_cast<int>(motion.response.stances.size()), motion.frame_count);
  double lowest_m = motion.root[0].p_m.y;
  for (std::size_t f = 0; f < motion.root.size(); ++f) {
    EXPECT_EQ(motion.response.stances[f].footing, Footing::standing);
    EXPECT_LT(glm::length(motion.root[f].p_m - motion.response.target_root[f].p_m), 0.02) << f;
    // The target is the recording, moved as far as balance asks.
    EXPECT_LT(glm::length(motion.response.target_root[f].p_m - t.original.root[f].p_m), 0.02) << f;
    lowest_m = std::min(lowest_m, motion.root[f].p_m.y);
  }
  EXPECT_LT(lowest_m, motion.root[0].p_m.y - 0.05);  // it did go down
}

// Another skeleton: half as high again, arms spread at rest, one link for each of our three hinges, other frames.
struct Stranger {
  Asset asset;
  int add(const std::string& name, int parent, const Vec3& position, const Quat& rotation = kNoRotation) {
    AssetNode node;
    node.name = node.label = name, node.parent = parent;
    node.rest = {position, rotation, Vec3(1.0)};
    asset.nodes.push_back(node);
    asset.order.push_back(static_cast<int>(asset.nodes.size()) - 1);
    return asset.order.back();
  }
  int hips = add("Hips", -1, {0, 1.5, 0});
  int arm = add("Arm", hips, {0.3, 0.6, 0}, axis_angle({0, 0, 1}, kPi / 2));
  int forearm = add("Forearm", arm, {0, -0.4, 0});  // along -Y of a frame that is turned: to the left

  // Both ends of one second: the arm turned in the world from spread to this.
  void turn_arm(const Quat& world_turn) {
    AssetChannel channel;
    channel.node = arm, channel.path = ChannelPath::rotation;
    channel.times_s = {0.0, 1.0};
    for (const Quat& q : {asset.nodes[static_cast<std::size_t>(arm)].rest.rotation,
                          world_turn * asset.nodes[static_cast<std::size_t>(arm)].rest.rotation})
      channel.values.insert(channel.values.end(), {q.x, q.y, q.z, q.w});
    AssetClip clip;
    clip.name = clip.label = "wave", clip.last_s = 1.0;
    clip.channels.push_back(channel);
    asset.clips.push_back(clip);
  }
};

const std::map<std::string, std::string> kStrangersJoints = {
    {"Hips", "root"}, {"Arm", "arm_left/shoulder"}, {"Forearm", "arm_left/elbow"}};

Vec3 upper_arm(const Character& character, const Motion& motion, int frame) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, motion.root[static_cast<std::size_t>(frame)], motion.row(frame), world);
  const auto at = [&](const char* name) { return world[static_cast<std::size_t>(character.find_joint(name))].p_m; };
  return glm::normalize(at("arm_left/elbow") - at("arm_left/shoulder"));
}

TEST(Recording, BonesPointWhereAStrangersDo) {
  const Character character = human();
  for (const Vec3& turn : {Vec3(0, -1.2, 0), Vec3(0, 0.4, 0.5), Vec3(0, 0, -1.3)}) {
    Stranger stranger;
    stranger.turn_arm(from_rotation_vector(turn));
    const Result<Motion> motion =
        follow_recording(character, {stranger.asset, stranger.asset.clips[0], kStrangersJoints, 0.0, 30.0, 0, {}});
    ASSERT_TRUE(motion) << to_line(motion.issue());
    ASSERT_EQ(motion->frame_count, 31);
    EXPECT_LT(glm::length(upper_arm(character, *motion, 0) - Vec3(1, 0, 0)), 1e-9);
    EXPECT_LT(glm::length(upper_arm(character, *motion, 30) - from_rotation_vector(turn) * Vec3(1, 0, 0)), 1e-9);
    EXPECT_NEAR(motion->root[0].p_m.y, character.rest_root().p_m.y, 1e-12);
  }
}

TEST(Recording, ACoordinateNeverJumpsToItsOtherSolution) {
  const Character character = human();
  Stranger stranger;
  stranger.turn_arm(from_rotation_vector({0.9, -2.0, 0.8}));
  const Motion motion =
      *follow_recording(character, {stranger.asset, stranger.asset.clips[0], kStrangersJoints, 0.0, 120.0, 0, {}});
  for (int f = 1; f < motion.frame_count; ++f)
    for (std::size_t c = 0; c < motion.row(f).size(); ++c)
      EXPECT_LT(std::fabs(motion.row(f)[c] - motion.row(f - 1)[c]), 0.2) << f << " " << c;
}

// An imported character keeps the names of its joints, but calls its root "root".
TEST(Recording, ARootWithoutANodeFollowsTheNodeThatCarriesAllJoints) {
  const Character character = human();
  Stranger stranger;
  stranger.turn_arm(from_rotation_vector({0, 0.4, 0.5}));
  std::map<std::string, std::string> joints = kStrangersJoints;
  const auto play = [&] {
    return follow_recording(character, {stranger.asset, stranger.asset.clips[0], joints, 0.0, 30.0, 0, {}});
  };
  const Result<Motion> given = play();
  joints.erase("Hips");
  const Result<Motion> found = play();
  ASSERT_TRUE(given.ok() && found.ok());
  EXPECT_EQ(*found, *given);
  joints.erase("Arm"), joints.erase("Forearm");
  const Result<Motion> none = play();
  ASSERT_FALSE(none);
  EXPECT_EQ(none.issue().code, "recording.no_root");
}

std::string refused(const Spec& spec, const Library& library) {
  const Result<Stage> stage = build_stage(spec, library);
  return stage ? "" : stage.issue().code + " " + stage.issue().pointer;
}

TEST(Recording, WhatDoesNotFitIsRefusedByName) {
  Taken t = taken(scene("human_tracking"));
  Spec spec = t.spec;
  spec.recording.name = "other";
  EXPECT_EQ(refused(spec, t.library), "recording.unknown_name /recording/name");
  spec = t.spec, spec.recording.clip = "other";
  EXPECT_EQ(refused(spec, t.library), "recording.unknown_clip /recording/clip");
  spec = t.spec, spec.recording.joints = {{"root", "arm_left/wing"}};
  EXPECT_EQ(refused(spec, t.library), "recording.unknown_joint /recording/joints/root");
  spec = t.spec, spec.recording.joints = {{"wing", "arm_left/elbow"}};
  EXPECT_EQ(refused(spec, t.library), "recording.unknown_node /recording/joints/wing");
  spec = t.spec, spec.recording.joints = {{"arm_left/elbow", "root"}, {"arm_right/elbow", "root"}};
  EXPECT_EQ(refused(spec, t.library), "recording.duplicate_joint /recording/joints/arm_right/elbow");
  spec = t.spec, spec.recording.from_s = 100.0;
  EXPECT_EQ(refused(spec, t.library), "recording.too_late /recording/from_s");
  spec = t.spec, spec.sequences = scene("human_tracking").sequences;
  EXPECT_EQ(refused(spec, t.library), "recording.with_sequences /recording");
  spec = t.spec, spec.rate_hz = 1000.0, spec.hold_frames = 6000;
  EXPECT_EQ(refused(spec, t.library), "");
  t.library.recordings["taken"] = std::make_shared<const Asset>(Stranger().asset);
  EXPECT_EQ(refused(t.spec, t.library), "recording.unknown_clip /recording/clip");
}

TEST(Recording, TwoFilesOfOneNameAreRefused) {
  const TempFolder folder;
  const Stage stage = *build_stage(scene("human_tracking"), stock_library());
  EXPECT_TRUE(save_glb(folder / "taken.glb", *stage.character, generate(stage), {}));
  Library library = stock_library();
  EXPECT_TRUE(load_recordings(folder.path(), library));
  const Result<Done> twice = load_recordings(folder.path(), library);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.issue().code, "recording.duplicate_name");
}

TEST(Recording, ATakeNeedsItsSkeletonBesideIt) {
  const TempFolder folder;
  spill(folder / "take.amc", small_amc());
  Library library = stock_library();
  const Result<Done> alone = load_recordings(folder.path(), library);
  ASSERT_FALSE(alone);
  EXPECT_EQ(alone.issue().code, "check.no_skeleton");
  spill(folder / "take.asf", small_asf());
  ASSERT_TRUE(load_recordings(folder.path(), library));
  EXPECT_EQ(library.recordings.at("take")->clips.size(), 1U);
}

}  // namespace
}  // namespace contort
