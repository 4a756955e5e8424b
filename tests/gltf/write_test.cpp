#include "formats/gltf/write.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <set>

#include "formats/gltf/read.h"
#include "model/asset/sample.h"
#include "model/core/detmath.h"
#include "model/motion/kinematics.h"
#include "tests/gltf/glb_builder.h"

namespace contort {
namespace {

using fixtures::Json;

const double kNotANumber = std::numeric_limits<double>::quiet_NaN();

Character stock(const std::string& name) {
  CharacterChoice choice;
  choice.name = name;
  const auto built = build_character(choice, stock_library());
  EXPECT_TRUE(built.ok()) << to_line(built.issue());
  return *built;
}

const Character& human() {
  static const Character character = stock("human");
  return character;
}

const Character& mech() {
  static const Character character = stock("mech");
  return character;
}

void set_coords(const Joint& joint, double phase, std::span<double> row) {
  const auto at = static_cast<std::size_t>(joint.coord);
  const double wave = det::sin(phase + joint.coord);
  if (coord_size(joint.kind) == 1) row[at] = joint.low + (joint.high - joint.low) * (0.5 + 0.5 * wave);
  if (joint.kind != JointKind::ball) return;
  const Quat q = axis_angle(joint.swing_axis, 4.0 * wave);  // w changes its sign on the way
  row[at] = q.w;
  row[at + 1] = q.x;
  row[at + 2] = q.y;
  row[at + 3] = q.z;
}

// Every joint swings, the root walks in circles.
Motion swinging(const Character& character, int frames) {
  Motion out;
  out.frame_count = frames;
  out.coord_count = character.coord_count();
  out.coords.resize(static_cast<std::size_t>(frames * out.coord_count));
  for (int frame = 0; frame < frames; ++frame) {
    for (const Joint& joint : character.joints()) set_coords(joint, 0.13 * frame, out.row(frame));
    Rigid root = character.rest_root();
    root.q = axis_angle(Vec3(0, 1, 0), 0.2 * frame);
    root.p_m += Vec3(0.02 * frame, 0, det::sin(0.1 * frame));
    out.root.push_back(root);
  }
  return out;
}

Asset written(const Character& character, const Motion& motion) {
  const auto bytes = write_glb(character, motion, {});
  EXPECT_TRUE(bytes.ok()) << to_line(bytes.issue());
  const auto asset = bytes.ok() ? parse_glb(*bytes) : Result<Asset>(bytes.issue());
  EXPECT_TRUE(asset.ok()) << to_line(asset.issue());
  return asset.ok() ? *asset : Asset{};
}

Json document_of(const std::vector<std::byte>& glb) {
  const std::string text(reinterpret_cast<const char*>(glb.data()), glb.size());
  const std::size_t length = std::to_integer<std::size_t>(glb[12]) + 256 * std::to_integer<std::size_t>(glb[13]) +
                             65536 * std::to_integer<std::size_t>(glb[14]);
  return Json::parse(text.substr(20, length));
}

std::vector<Rigid> world_of(const Asset& asset, const std::vector<Trs>& local) {
  std::vector<Rigid> out(local.size());
  for (const int node : asset.order) {
    const auto i = static_cast<std::size_t>(node);
    const Rigid parent_from_node{local[i].rotation, local[i].translation};
    const int parent = asset.nodes[i].parent;
    out[i] = parent < 0 ? parent_from_node : out[static_cast<std::size_t>(parent)] * parent_from_node;
  }
  return out;
}

// A viewer shows the same places as the kinematics, for each node and frame.
void expect_same_places(const Character& character) {
  const Motion motion = swinging(character, 40);
  const Asset asset = written(character, motion);
  ASSERT_EQ(asset.nodes.size(), character.joints().size());
  ASSERT_EQ(asset.clips.size(), 1U);
  std::vector<Rigid> world(character.joints().size());
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    forward_kinematics(character, motion.root[static_cast<std::size_t>(frame)], motion.row(frame), world);
    const auto t = static_cast<double>(static_cast<float>(frame / motion.rate_hz));
    const std::vector<Rigid> shown = world_of(asset, pose(asset, asset.clips[0], t));
    for (std::size_t i = 0; i < world.size(); ++i) {
      // Measured worst: 3e-7 m and 5e-7 rad, from 32-bit numbers.
      EXPECT_LT(glm::length(shown[i].p_m - world[i].p_m), 2e-6) << frame << " " << character.joints()[i].name;
      EXPECT_LT(rotation_angle(glm::conjugate(shown[i].q) * world[i].q), 2e-6) << character.joints()[i].name;
    }
  }
}

TEST(WriteGlb, PlacesEveryJointOfAHumanAsTheMotionDoes) { expect_same_places(human()); }
TEST(WriteGlb, PlacesEveryJointOfAMechAsTheMotionDoes) { expect_same_places(mech()); }

TEST(WriteGlb, NamesNodesLikeJoints) {
  const Asset asset = written(human(), Motion{});
  for (std::size_t i = 0; i < asset.nodes.size(); ++i) {
    EXPECT_EQ(asset.nodes[i].name, human().joints()[i].name);
    EXPECT_EQ(asset.nodes[i].parent, human().joints()[i].parent);
  }
}

TEST(WriteGlb, WithoutFramesShowsTheRestPose) {
  const Asset asset = written(human(), Motion{});
  EXPECT_TRUE(asset.clips.empty());
  EXPECT_EQ(asset.nodes[0].rest.translation, human().rest_root().p_m);
}

TEST(WriteGlb, HasAKeyForEveryFrame) {
  const Motion motion = swinging(mech(), 7);
  const Asset asset = written(mech(), motion);
  std::size_t moving = 1;  // the root has two channels, all others one
  for (const AssetChannel& channel : asset.clips[0].channels) {
    EXPECT_EQ(channel.times_s.size(), 7U);
    EXPECT_EQ(channel.interpolation, Interpolation::linear);
    EXPECT_EQ(channel.times_s[6], static_cast<double>(static_cast<float>(6.0 / 60.0)));
  }
  for (const Joint& joint : mech().joints()) moving += joint.kind == JointKind::root ? 1 : coord_size(joint.kind) > 0;
  EXPECT_EQ(asset.clips[0].channels.size(), moving);
}

TEST(WriteGlb, KeepsTheSignsOfQuaternionsTogether) {
  const Asset asset = written(human(), swinging(human(), 60));
  for (const AssetChannel& channel : asset.clips[0].channels) {
    if (channel.path != ChannelPath::rotation) continue;
    for (std::size_t i = 4; i < channel.values.size(); i += 4) {
      double dot = 0.0;
      for (std::size_t c = 0; c < 4; ++c) dot += channel.values[i + c] * channel.values[i + c - 4];
      EXPECT_GE(dot, 0.0) << asset.nodes[static_cast<std::size_t>(channel.node)].name;
    }
  }
}

TEST(WriteGlb, HasOneMaterialPerColour) {
  const auto bytes = write_glb(human(), Motion{}, {});
  ASSERT_TRUE(bytes.ok());
  std::set<std::vector<double>> colors;
  for (const MeshPiece& piece : human().mesh()) colors.insert({piece.color.x, piece.color.y, piece.color.z, 1.0});
  const Json document = document_of(*bytes);
  EXPECT_EQ(document["materials"].size(), colors.size());
  for (const Json& material : document["materials"])
    EXPECT_TRUE(colors.contains(material["pbrMetallicRoughness"]["baseColorFactor"].get<std::vector<double>>()));
}

TEST(WriteGlb, CarriesTheCaseAndTheReplayCommand) {
  const Motion motion = swinging(mech(), 2);
  const auto bytes = write_glb(mech(), motion, {"0123abcd", "contort replay \"a b\".json"});
  ASSERT_TRUE(bytes.ok());
  const Json extras = document_of(*bytes)["scenes"][0]["extras"];
  EXPECT_EQ(extras["case"], "0123abcd");
  EXPECT_EQ(extras["replay"], "contort replay \"a b\".json");
  EXPECT_FALSE(document_of(*write_glb(mech(), motion, {}))["scenes"][0].contains("extras"));
}

TEST(WriteGlb, GivesEqualBytesForEqualInput) {
  const Motion motion = swinging(human(), 5);
  EXPECT_EQ(*write_glb(human(), motion, {"a", "b"}), *write_glb(human(), motion, {"a", "b"}));
}

// ---- motions that cannot be written

std::size_t moving_joint(const Character& character, JointKind kind) {
  const auto joints = character.joints();
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i].kind == kind) return i;
  ADD_FAILURE();
  return 0;
}

Issue issue_of(const Character& character, const Motion& motion, const GltfExtras& extras = {}) {
  const auto bytes = write_glb(character, motion, extras);
  EXPECT_FALSE(bytes.ok());
  return bytes.ok() ? Issue{} : bytes.issue();
}

TEST(WriteGlb, NamesTheFirstFrameAndJointThatIsNotFinite) {
  const std::size_t hinge = moving_joint(human(), JointKind::hinge);
  const Joint& joint = human().joints()[hinge];
  for (const double bad : {kNotANumber, std::numeric_limits<double>::infinity()}) {
    Motion motion = swinging(human(), 6);
    motion.row(3)[static_cast<std::size_t>(joint.coord)] = bad;
    motion.row(5)[0] = kNotANumber;
    const Issue issue = issue_of(human(), motion);
    EXPECT_EQ(issue.code, "gltf.not_finite");
    EXPECT_EQ(issue.pointer, "/coords/" + std::to_string(3 * motion.coord_count + joint.coord));
    EXPECT_NE(issue.text.find("frame 3, joint \"" + joint.name + "\""), std::string::npos) << issue.text;
  }
}

TEST(WriteGlb, RefusesRootsThatAreNotFiniteOrTooFarAway) {
  for (const double bad : {kNotANumber, -std::numeric_limits<double>::infinity(), 1e39}) {
    Motion motion = swinging(human(), 4);
    motion.root[2].p_m.y = bad;
    const Issue issue = issue_of(human(), motion);
    EXPECT_EQ(issue.code, "gltf.not_finite");
    EXPECT_EQ(issue.pointer, "/root/2");
  }
}

TEST(WriteGlb, RefusesRotationsOfLengthZero) {
  Motion motion = swinging(human(), 4);
  motion.root[1].q = Quat(0, 0, 0, 0);
  EXPECT_EQ(issue_of(human(), motion).code, "gltf.not_unit");
}

TEST(WriteGlb, NormalisesRotations) {
  Motion motion = swinging(human(), 1);
  motion.root[0].q = Quat(3, 0, 0, 0);
  EXPECT_EQ(pose(written(human(), motion), written(human(), motion).clips[0], 0.0)[0].rotation, kNoRotation);
}

TEST(WriteGlb, RefusesMotionsOfAnotherCharacter) {
  EXPECT_EQ(issue_of(mech(), swinging(human(), 2)).code, "gltf.wrong_character");
  Motion short_root = swinging(human(), 2);
  short_root.root.pop_back();
  EXPECT_EQ(issue_of(human(), short_root).code, "gltf.wrong_character");
}

TEST(WriteGlb, RefusesRatesThatAreNoRates) {
  for (const double rate : {0.0, -1.0, kNotANumber, std::numeric_limits<double>::infinity()}) {
    Motion motion = swinging(human(), 2);
    motion.rate_hz = rate;
    EXPECT_EQ(issue_of(human(), motion).code, "gltf.bad_rate") << rate;
  }
}

TEST(WriteGlb, RefusesTimesThatFloatsCannotTellApart) {
  Motion motion = swinging(human(), 3);
  motion.rate_hz = 1e-300;
  EXPECT_EQ(issue_of(human(), motion).code, "gltf.too_large");
  motion.rate_hz = 1e300;
  EXPECT_EQ(issue_of(human(), motion).code, "gltf.too_large");
}

TEST(WriteGlb, RefusesTextsThatAreNotUtf8) {
  EXPECT_EQ(issue_of(human(), swinging(human(), 1), {"\xff", ""}).code, "gltf.bad_text");
}

TEST(SaveGlb, WritesAFileThatReadsBack) {
  const auto path =
      (std::filesystem::temp_directory_path() / ("contort_" + std::to_string(::getpid()) + ".glb")).string();
  const Motion motion = swinging(human(), 3);
  ASSERT_TRUE(save_glb(path, human(), motion, {}).ok());
  const auto asset = read_gltf(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(asset.ok()) << to_line(asset.issue());
  EXPECT_EQ(*asset, written(human(), motion));
}

TEST(SaveGlb, SaysWhyItCannotWrite) {
  const auto saved = save_glb("/nonexistent/folder/x.glb", human(), Motion{}, {});
  ASSERT_FALSE(saved.ok());
  EXPECT_EQ(saved.issue().code, "file.unwritable");
}

// Speeds that a reader measures in the file equal those of the motion.
RC_GTEST_PROP(WriteGlbProperty, HingeSpeedsSurvive, ()) {
  const auto steps = *rc::gen::container<std::vector<int>>(8, rc::gen::inRange(-30, 30));
  const std::size_t hinge = moving_joint(human(), JointKind::hinge);
  Motion motion = swinging(human(), 8);
  double angle = 0.0;
  for (int frame = 0; frame < 8; ++frame) {
    angle += steps[static_cast<std::size_t>(frame)] / 100.0;
    motion.row(frame)[static_cast<std::size_t>(human().joints()[hinge].coord)] = angle;
  }
  const Asset asset = written(human(), motion);
  for (const ChannelSpeeds& channel : joint_speeds(asset.clips[0])) {
    if (channel.node != static_cast<int>(hinge)) continue;
    for (std::size_t i = 0; i < 7; ++i)
      RC_ASSERT(std::fabs(channel.between_keys[i].speed_rad_s - 60.0 * std::abs(steps[i + 1]) / 100.0) < 1e-3);
  }
}

}  // namespace
}  // namespace contort
