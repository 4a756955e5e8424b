// Speeds of glTF clips, on assets made by hand and on four real files.
#include "checks/clip_speed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "formats/gltf/read.h"

namespace contort {

namespace {

constexpr double kHigh = 1e9;  // no limit

Asset one_node(const std::string& name = "elbow") {
  Asset asset;
  AssetNode node;
  node.name = name;
  node.label = name;
  asset.nodes = {node};
  asset.order = {0};
  asset.clips.push_back({"wave", "wave", {}, 0.0, 0.0});
  return asset;
}

void add_row(AssetChannel& channel, const Quat& q) {
  for (const double v : {q.x, q.y, q.z, q.w}) channel.values.push_back(v);
}

AssetChannel turning(const std::vector<double>& times_s, const std::vector<double>& angles_rad,
                     Interpolation interpolation = Interpolation::linear, int node = 0) {
  AssetChannel channel{node, ChannelPath::rotation, interpolation, times_s, {}};
  for (const double angle : angles_rad) add_row(channel, axis_angle(Vec3(0, 0, 1), angle));
  return channel;
}

// Cubic keys about Z; all tangents have the given rate of the angle, as a rate of the quaternion.
AssetChannel spline(const std::vector<double>& times_s, const std::vector<double>& angles_rad, double rate_rad_s) {
  AssetChannel channel{0, ChannelPath::rotation, Interpolation::cubic_spline, times_s, {}};
  for (const double angle : angles_rad) {
    const double half = 0.5 * angle;
    const Quat tangent = Quat(-std::sin(half), 0, 0, std::cos(half)) * (0.5 * rate_rad_s);
    add_row(channel, tangent);
    add_row(channel, axis_angle(Vec3(0, 0, 1), angle));
    add_row(channel, tangent);
  }
  return channel;
}

ClipSpeeds speeds(const AssetChannel& channel, double limit_rad_s = kHigh) {
  Asset asset = one_node();
  asset.clips[0].channels = {channel};
  return check_clip_speeds(asset, {limit_rad_s, {}}).at(0);
}

TEST(ClipSpeed, LinearTakesTheAngleBetweenNeighbouringKeys) {
  const ClipSpeeds s = speeds(turning({0, 0.5, 0.75, 2.0}, {0, 0.2, 0.5, 0.4}));
  EXPECT_NEAR(s.peak_rad_s, 0.3 / 0.25, 1e-12);
  EXPECT_EQ(s.peak_node, "elbow");
  EXPECT_EQ(s.peak_t0_s, 0.5);
  EXPECT_EQ(s.peak_t1_s, 0.75);
  EXPECT_EQ(s.channels, 1);
}

TEST(ClipSpeed, EachJumpOfAStepIsAPopOfItsOwn) {
  const ClipSpeeds s = speeds(turning({0, 0.5, 0.75, 2.0, 3.0}, {0, 1.2, 1.2, 0.1, 1.3}, Interpolation::step), 50.0);
  EXPECT_NEAR(s.peak_rad_s, 1.2 * 60.0, 1e-9);
  ASSERT_EQ(s.findings.size(), 3U);
  for (const ClipFinding& f : s.findings) EXPECT_EQ(f.finding.check, "pop");
  EXPECT_EQ(s.findings[0].worst_t1_s, 0.5);
  EXPECT_EQ(s.findings[1].worst_t1_s, 2.0);
  EXPECT_EQ(s.findings[2].worst_t1_s, 3.0);
  EXPECT_EQ(s.findings[1].finding.first_frame, 2);
  EXPECT_EQ(s.findings[1].finding.last_frame, 2);
}

TEST(ClipSpeed, TheSignOfAQuaternionIsNoMotion) {
  AssetChannel channel{0, ChannelPath::rotation, Interpolation::linear, {0, 1, 2}, {}};
  const Quat q = axis_angle(Vec3(0, 0, 1), 0.1);
  for (const Quat& key : {Quat(1, 0, 0, 0), -q, q}) add_row(channel, key);
  const ClipSpeeds s = speeds(channel);
  EXPECT_NEAR(s.peak_rad_s, 0.1, 1e-12);
  EXPECT_EQ(s.peak_t0_s, 0.0);
}

TEST(ClipSpeed, ASplineIsSampledBetweenItsKeys) {
  // The clip turns by a radian in a second, from rest to rest: a smoothstep, at most 1.5 and, over an eighth, 1.49.
  const ClipSpeeds s = speeds(spline({0, 1}, {0, 1.0}, 0.0));
  EXPECT_GT(s.peak_rad_s, 1.4);
  EXPECT_LT(s.peak_rad_s, 1.55);
  EXPECT_GE(s.peak_t0_s, 0.25);
  EXPECT_LE(s.peak_t1_s, 0.75);
  EXPECT_EQ(speeds(spline({0, 1}, {0, 0}, 0.0)).peak_rad_s, 0.0);
}

TEST(ClipSpeed, ASplineThatLeavesAndComesBackIsNotAtRest) {
  EXPECT_GT(speeds(spline({0, 1}, {0, 0}, 2.0)).peak_rad_s, 1.0);
}

TEST(ClipSpeed, AFindingIsAnEpisodeOfKeyIntervals) {
  const ClipSpeeds s = speeds(turning({0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, 2, 3.0, 3.1, 3.2, 3.3, 3.4, 5.4, 5.4}), 0.5);
  ASSERT_EQ(s.findings.size(), 2U);
  const ClipFinding& first = s.findings[0];
  EXPECT_EQ(first.finding.check, "angular_velocity");
  EXPECT_EQ(first.finding.subject, "elbow");
  EXPECT_EQ(first.finding.unit, "rad/s");
  EXPECT_EQ(first.finding.first_frame, 0);
  EXPECT_EQ(first.finding.worst_frame, 0);
  EXPECT_EQ(first.finding.last_frame, 1);
  EXPECT_NEAR(first.finding.worst_margin, -1.5, 1e-12);
  EXPECT_NEAR(first.finding.depth, 1.5, 1e-12);
  EXPECT_NEAR(first.worst_speed_rad_s, 2.0, 1e-12);
  EXPECT_EQ(s.findings[1].finding.first_frame, 6);
  EXPECT_EQ(s.findings[1].worst_t0_s, 6.0);
  EXPECT_EQ(s.findings[1].worst_t1_s, 7.0);
}

TEST(ClipSpeed, ALimitIsForItsNodeByLabelOrName) {
  Asset asset = one_node("knee");
  asset.nodes[0].label = "knee#0";
  asset.clips[0].channels = {turning({0, 1}, {0, 1})};
  const auto findings = [&](const SpeedLimits& limits) { return check_clip_speeds(asset, limits)[0].findings.size(); };
  EXPECT_EQ(findings({kHigh, {}}), 0U);
  EXPECT_EQ(findings({kHigh, {{"knee", 1.0 - 1e-6}}}), 1U);
  EXPECT_EQ(findings({kHigh, {{"knee", 1.0 + 1e-6}}}), 0U);
  EXPECT_EQ(findings({0.1, {{"knee", 2.0}}}), 0U);
  EXPECT_EQ(findings({0.1, {{"hip", 2.0}}}), 1U);
  EXPECT_EQ(findings({kHigh, {{"knee", 9.0}, {"knee#0", 0.5}}}), 1U) << "the label says more than the name";
}

TEST(ClipSpeed, ATurnInNoTimeIsAsFastAsAFrameShowsItAndStandingStillIsNot) {
  EXPECT_NEAR(speeds(turning({0, 1, 1, 2}, {0, 0, 1, 1})).peak_rad_s, 60.0, 1e-9);
  EXPECT_NEAR(speeds(turning({0, 1, 1, 2}, {0, 0.5, 0.5, 1})).peak_rad_s, 0.5, 1e-12);
}

// Keys at equal times have no interval between them; the peaks of neighbouring intervals must not be assigned to it.
TEST(ClipSpeed, ASplineWithKeysAtOneTimeIsStillSampledInside) {
  const ClipSpeeds s = speeds(spline({0, 0, 0, 1}, {0, 0, 0, 1.0}, 0.0), 1.2);
  EXPECT_GT(s.peak_rad_s, 1.4);
  ASSERT_EQ(s.findings.size(), 1U);
  EXPECT_EQ(s.findings[0].finding.first_frame, 2);
  EXPECT_EQ(s.findings[0].finding.last_frame, 2);
}

TEST(ClipSpeed, OnlyTheClipThatWasAskedForIsChecked) {
  Asset asset = one_node();
  asset.clips[0].channels = {turning({0, 1}, {0, 1})};
  asset.clips.push_back({"walk", "walk#1", {turning({0, 1}, {0, 2})}, 0, 1});
  EXPECT_EQ(check_clip_speeds(asset, {kHigh, {}}).size(), 2U);
  for (const char* name : {"walk", "walk#1"}) {
    const std::vector<ClipSpeeds> one = check_clip_speeds(asset, {kHigh, {}}, name);
    ASSERT_EQ(one.size(), 1U) << name;
    EXPECT_NEAR(one[0].peak_rad_s, 2.0, 1e-12);
  }
  EXPECT_TRUE(check_clip_speeds(asset, {kHigh, {}}, "run").empty());
}

TEST(ClipSpeed, AClipWithoutRotationsHasNoPeak) {
  Asset asset = one_node();
  asset.clips[0].channels = {{0, ChannelPath::translation, Interpolation::linear, {0, 1}, {0, 0, 0, 9, 9, 9}}};
  const ClipSpeeds s = check_clip_speeds(asset, {0.1, {}})[0];
  EXPECT_EQ(s.peak_rad_s, 0.0);
  EXPECT_EQ(s.peak_node, "");
  EXPECT_EQ(s.channels, 0);
  EXPECT_TRUE(s.findings.empty());
}

TEST(ClipSpeed, OneKeyIsNoMotion) { EXPECT_EQ(speeds(turning({1.0}, {2.0})).peak_rad_s, 0.0); }

// The peak speeds that other programs measured in real files (assets/MANIFEST.tsv).
struct RealPeak {
  const char* file;
  const char* clip;
  const char* node;
  double deg_s;
};

// Prints no bytes: they contain addresses, and names of tests must stay the same.
void PrintTo(const RealPeak& peak, std::ostream* out) { *out << std::filesystem::path(peak.file).stem().string(); }

class RealFile : public testing::TestWithParam<RealPeak> {};

TEST_P(RealFile, HasThePeakThatTheManifestNames) {
  const RealPeak& expected = GetParam();
  const std::string assets = std::string(CONTORT_SOURCE_DIR) + "/../shared/assets/";
  if (!std::filesystem::exists(assets + "MANIFEST.tsv")) GTEST_SKIP() << "no " << assets << "MANIFEST.tsv";
  const Result<Asset> asset = read_gltf(assets + "gltf/characters/" + expected.file);
  ASSERT_TRUE(asset) << to_line(asset.issue());
  ClipSpeeds fastest;
  for (const ClipSpeeds& clip : check_clip_speeds(*asset, {kHigh, {}}))
    if (clip.peak_rad_s > fastest.peak_rad_s) fastest = clip;
  EXPECT_NEAR(fastest.peak_rad_s * kDegPerRad, expected.deg_s, 0.01 * expected.deg_s + 0.5);
  EXPECT_EQ(fastest.peak_node, expected.node);
  if (*expected.clip != 0) {
    EXPECT_EQ(fastest.clip, expected.clip);
  }
}

INSTANTIATE_TEST_SUITE_P(
    ClipSpeed, RealFile,
    testing::Values(RealPeak{"khronos/RiggedFigure/glTF-Binary/RiggedFigure.glb", "", "arm_joint_R_1", 34},
                    RealPeak{"khronos/CesiumMan/glTF-Binary/CesiumMan.glb", "", "leg_joint_L_2", 545},
                    RealPeak{"khronos/Fox/glTF-Binary/Fox.glb", "Walk", "b_LeftHand_011", 1482},
                    RealPeak{"raylib/robot.glb", "Robot_Punch", "UpperArm.R", 2983}));

}  // namespace

}  // namespace contort
