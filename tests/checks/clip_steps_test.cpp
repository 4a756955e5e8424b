// translation_pop, scale_pop, jitter and bind_pose_flash of clips: motions with and without findings.
#include <gtest/gtest.h>

#include "checks/judge_clip.h"
#include "model/core/index.h"

namespace contort {
namespace {

// Hips, spine and arm above each other, 0.3 m apart, without a channel.
Asset chain_of_three() {
  Asset asset;
  for (const char* name : {"hips", "spine", "arm"}) {
    AssetNode node;
    node.name = node.label = name;
    node.parent = static_cast<int>(asset.nodes.size()) - 1;
    node.rest.translation = Vec3(0.0, 0.3, 0.0);
    node.is_joint = true;
    asset.order.push_back(static_cast<int>(asset.nodes.size()));
    asset.nodes.push_back(node);
  }
  asset.clips.push_back({"wave", "wave", {}, 0.0, 0.0});
  return asset;
}

// Adds a channel with this many keys a second.
void add_channel_of(Asset& asset, int node, ChannelPath path, const std::vector<std::vector<double>>& rows,
                    double rate_hz = 30.0) {
  AssetChannel channel;
  channel.node = node, channel.path = path;
  for (const std::vector<double>& row : rows) {
    channel.times_s.push_back(static_cast<double>(channel.times_s.size()) / rate_hz);
    channel.values.insert(channel.values.end(), row.begin(), row.end());
  }
  asset.clips[0].last_s = channel.times_s.back();
  asset.clips[0].channels.push_back(std::move(channel));
}

std::vector<std::vector<double>> turns_about_x(const std::vector<double>& angles_deg) {
  std::vector<std::vector<double>> rows;
  for (const double angle : angles_deg) {
    const Quat q = axis_angle(Vec3(1, 0, 0), angle * kRadPerDeg);
    rows.push_back({q.x, q.y, q.z, q.w});
  }
  return rows;
}

std::vector<std::vector<double>> along_y(const std::vector<double>& places_m) {
  std::vector<std::vector<double>> rows;
  for (const double y : places_m) rows.push_back({0.0, y, 0.0});
  return rows;
}

std::vector<std::vector<double>> evenly(const std::vector<double>& scales) {
  std::vector<std::vector<double>> rows;
  for (const double s : scales) rows.push_back({s, s, s});
  return rows;
}

ClipEvaluation judged_of(const Asset& asset, const CheckSettings& settings = {}, bool is_loop = false) {
  return judge_clip({asset, asset.clips[0], settings, is_loop, {}}, {3000.0 * kRadPerDeg, {}, settings}, nullptr);
}

std::vector<KeyFinding> found_in(const Asset& asset, const CheckSettings& settings = {}, bool is_loop = false) {
  return judged_of(asset, settings, is_loop).clip_findings;
}

std::vector<KeyFinding> moved(const std::vector<double>& places_m, int node = 2) {
  Asset asset = chain_of_three();
  add_channel_of(asset, node, ChannelPath::translation, along_y(places_m));
  return found_in(asset);
}

std::vector<KeyFinding> scaled(const std::vector<double>& scales) {
  Asset asset = chain_of_three();
  add_channel_of(asset, 2, ChannelPath::scale, evenly(scales));
  return found_in(asset);
}

std::vector<ClipFinding> pops_of(const std::vector<double>& angles_deg, const CheckSettings& settings = {}) {
  Asset asset = chain_of_three();
  add_channel_of(asset, 2, ChannelPath::rotation, turns_about_x(angles_deg));
  return judged_of(asset, settings).speeds.findings;
}

TEST(TranslationPop, NamesTheKeyThatIsOffAndItsSpeed) {
  const std::vector<KeyFinding> found = moved({0.3, 0.3, 0.3, 0.3, 0.6, 0.3, 0.3, 0.3, 0.3});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].check, "translation_pop");
  EXPECT_EQ(found[0].subject, "arm");
  EXPECT_EQ(found[0].first_frame, 4);
  EXPECT_EQ(found[0].last_frame, 4);
  EXPECT_NEAR(found[0].t1_s, 4.0 / 30.0, 1e-12);
  EXPECT_TRUE(found[0].what.find("0.300 m between two keys (9.0 m/s)") != found[0].what.npos) << found[0].what;
}

TEST(TranslationPop, AWalkAndAStrideAreQuiet) {
  EXPECT_TRUE(moved({0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4}, 0).empty());
  EXPECT_TRUE(moved({0.3, 0.3, 0.35, 0.5, 0.55, 0.5, 0.35, 0.3, 0.3}).empty()) << "a bounce over several keys";
}

TEST(ScalePop, FindsMirrorsZeroesAndGiants) {
  for (const double odd : {-1.0, 0.0, 100.0, 1.2}) {
    const std::vector<KeyFinding> found = scaled({1, 1, 1, 1, odd, 1, 1, 1, 1});
    ASSERT_EQ(found.size(), 1U) << odd;
    EXPECT_EQ(found[0].check, "scale_pop");
    EXPECT_EQ(found[0].first_frame, 4);
  }
  EXPECT_EQ(scaled({1, 1, 1, 1, -1, -1, -1, -1, -1}).size(), 1U) << "mirrored from one key on";
  EXPECT_EQ(scaled({1, 1, 1, 1, 2, 2, 2, 2, 2}).size(), 1U) << "twice the size";
}

TEST(ScalePop, SquashesAndPartsThatAreHiddenAreQuiet) {
  EXPECT_TRUE(scaled({1, 1, 1.1, 1.3, 1.4, 1.3, 1.1, 1, 1}).empty());
  EXPECT_TRUE(scaled({1, 1, 1, 1, 0, 0, 0, 0, 0}).empty());
  EXPECT_TRUE(scaled({0, 0, 0, 0, 1, 1, 1, 1, 1}).empty());
  EXPECT_TRUE(scaled({100, 100, 100, 100, 101, 100, 100, 100, 100}).empty()) << "one part in a hundred";
}

TEST(PopBelowTheLimit, AJumpAndABlipThatStandAlone) {
  EXPECT_EQ(pops_of({0, 0, 1, 1, 55, 56, 56, 57, 57, 57}).size(), 1U);
  const std::vector<ClipFinding> blip = pops_of({0, 0, 0, 0, 6, 0, 0, 0, 0});
  ASSERT_EQ(blip.size(), 1U);
  EXPECT_EQ(blip[0].finding.check, "pop");
  EXPECT_TRUE(pops_of({0, 0, 10, 40, 80, 110, 120, 120, 120}).empty()) << "fast, and over several keys";
}

TEST(PopBelowTheLimit, ALeapInFastMotion) {
  EXPECT_EQ(pops_of({0, 5, 9, 13, 103, 138, 138, 188, 210, 220}).size(), 1U) << "90 deg in a frame are 2,700 deg/s";
  EXPECT_TRUE(pops_of({0, 5, 9, 13, 83, 118, 118, 158, 180, 190}).empty());
}

TEST(PopBelowTheLimit, ARuleMayBeStricter) {
  const std::vector<double> snap = {0, 2, 4, 20, 60, 64, 66, 70, 90, 95, 97, 99};
  EXPECT_TRUE(pops_of(snap).empty());
  CheckSettings settings;
  settings.limits = {{"pop", "*", "", LimitUse::change, -40.0, "30 Hz"}};
  const std::vector<ClipFinding> found = pops_of(snap, settings);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].finding.check, "pop");
  EXPECT_NEAR(found[0].worst_speed_rad_s + found[0].finding.worst_margin, 3000.0 * kRadPerDeg - 40.0, 1e-9);
  settings.limits[0].use = LimitUse::ignore;
  EXPECT_TRUE(pops_of({0, 0, 1, 1, 55, 56, 56, 57, 57, 57}, settings).empty());
}

TEST(Jitter, SaysHowFarAndHowOften) {
  std::vector<double> angles;
  for (int key = 0; key < 31; ++key) angles.push_back(key % 2 == 0 ? 6.0 : -6.0);
  Asset asset = chain_of_three();
  add_channel_of(asset, 2, ChannelPath::rotation, turns_about_x(angles));
  const std::vector<KeyFinding> found = found_in(asset);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].what, "shakes by 12.0 deg to and fro, 15.0 times a second");
}

TEST(Jitter, WavingHandsAndSmallTremorAreQuiet) {
  std::vector<double> wave, tremor;
  const double up_and_down[] = {0, 20, 30, 20, 0, -20, -30, -20};
  for (int key = 0; key < 61; ++key) wave.push_back(up_and_down[key % 8]), tremor.push_back(key % 2 == 0 ? 1.0 : -1.0);
  for (const std::vector<double>& angles : {wave, tremor}) {
    Asset asset = chain_of_three();
    add_channel_of(asset, 2, ChannelPath::rotation, turns_about_x(angles));
    EXPECT_TRUE(found_in(asset).empty());
  }
}

TEST(BindPoseFlashOfClips, OneKeyAtRestIsFoundAndAPassageIsNot) {
  const auto flashes = [](const std::vector<double>& hips, const std::vector<double>& arm) {
    Asset asset = chain_of_three();
    add_channel_of(asset, 0, ChannelPath::rotation, turns_about_x(hips));
    add_channel_of(asset, 2, ChannelPath::rotation, turns_about_x(arm));
    std::size_t count = 0;
    for (const KeyFinding& finding : found_in(asset)) count += finding.check == "bind_pose_flash" ? 1 : 0;
    return count;
  };
  EXPECT_EQ(flashes({20, 21, 22, 0, 23, 24, 25}, {70, 71, 72, 0, 73, 74, 75}), 1U);
  EXPECT_EQ(flashes({20, 21, 22, 0, 0, 24, 25}, {70, 71, 72, 0, 0, 74, 75}), 1U) << "two keys";
  EXPECT_EQ(flashes({-30, -20, -10, 0, 10, 20, 30}, {-60, -40, -20, 0, 20, 40, 60}), 0U) << "it swings through";
  EXPECT_EQ(flashes({30, 20, 10, 0, 10, 20, 30}, {60, 40, 20, 0, 20, 40, 60}), 0U) << "it goes there and back";
}

TEST(LoopSeamOfPlaces, HeightIsJudgedAndTheWayAlongTheGroundIsNot) {
  Asset asset = chain_of_three();
  add_channel_of(asset, 0, ChannelPath::translation, {{0, 1, 0}, {0, 1, 0.1}, {0, 1, 0.2}, {0, 1, 0.3}});
  EXPECT_TRUE(found_in(asset, {}, true).empty());
  asset.clips[0].channels.clear();
  add_channel_of(asset, 0, ChannelPath::translation, {{0, 1, 0}, {0, 1, 0}, {0, 1.1, 0}, {0, 1.2, 0}, {0, 1.3, 0}, {0, 1.3, 0}});
  const std::vector<KeyFinding> found = found_in(asset, {}, true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].check, "loop_seam");
  EXPECT_EQ(found[0].subject, "hips");
}

TEST(LoopSeamOfPlaces, AFirstKeyThatIsLateIsNamed) {
  Asset asset = chain_of_three();
  add_channel_of(asset, 2, ChannelPath::rotation, turns_about_x({0, 5, 5, 0}));
  for (double& t_s : asset.clips[0].channels[0].times_s) t_s += 0.5;
  asset.clips[0].first_s = 0.5;
  const std::vector<KeyFinding> found = found_in(asset, {}, true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].subject, "figure");
  EXPECT_EQ(found[0].unit, "s");
}

}  // namespace
}  // namespace contort
