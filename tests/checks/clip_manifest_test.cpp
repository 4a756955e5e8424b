// Checks of clips: each has an exemplar just inside its limit and one just outside, and a clip that it cannot judge.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include "checks/judge_clip.h"
#include "tests/checks/clip_legs.h"

namespace contort {
namespace {

struct ShownClip {
  Asset asset;
  bool is_loop = false;
  std::optional<double> max_gap_m;
  std::vector<ClipFoot> feet{};
};

// Three joints above each other, 0.3 m apart; the last one has a channel.
Asset joints_with(const AssetChannel& channel) {
  Asset asset;
  for (const char* name : {"hips", "spine", "arm"}) {
    AssetNode node;
    node.name = node.label = name;
    node.parent = static_cast<int>(asset.nodes.size()) - 1;
    node.rest.translation = Vec3(0.3, 0.0, 0.0);
    node.is_joint = true;
    asset.order.push_back(static_cast<int>(asset.nodes.size()));
    asset.nodes.push_back(node);
  }
  asset.clips.push_back({"wave", "wave", {channel}, 0.0, channel.times_s.back()});
  return asset;
}

AssetChannel turning_by(const std::vector<double>& angles_rad) {
  AssetChannel channel;
  channel.node = 2, channel.path = ChannelPath::rotation;
  for (const double angle : angles_rad) {
    channel.times_s.push_back(0.1 * static_cast<double>(channel.times_s.size()));
    const Quat q = axis_angle(Vec3(1, 0, 0), angle);
    for (const double value : {q.x, q.y, q.z, q.w}) channel.values.push_back(value);
  }
  return channel;
}

// A loop may gape by 1 degree.
ShownClip gaping(double inside) {
  const double seam_rad = kRadPerDeg - inside;
  return {joints_with(turning_by({0.0, 0.0, seam_rad, seam_rad})), true, {}};
}

ShownClip pulled_out(double inside) {
  AssetChannel channel;
  channel.node = 2, channel.times_s = {0.0, 0.1}, channel.values = {0.3, 0, 0, 0.31 - inside, 0, 0};
  return {joints_with(channel), false, 0.01};
}

// Keys of a channel of the last joint, 30 a second.
AssetChannel keys_of(ChannelPath path, const std::vector<Vec3>& values) {
  AssetChannel channel;
  channel.node = 2, channel.path = path;
  for (const Vec3& value : values) {
    channel.times_s.push_back(static_cast<double>(channel.times_s.size()) / 30.0);
    for (int i = 0; i < 3; ++i) channel.values.push_back(value[i]);
  }
  return channel;
}

AssetChannel turning_at_30_hz(const std::vector<double>& angles_rad) {
  AssetChannel channel = turning_by(angles_rad);
  for (std::size_t key = 0; key < channel.times_s.size(); ++key)
    channel.times_s[key] = static_cast<double>(key) / 30.0;
  return channel;
}

// The joints span 0.6 m, of which one hundredth is allowed.
ShownClip out_of_place(double inside) {
  std::vector<Vec3> places(13, Vec3(0.3, 0, 0));
  places[6].y = 0.006 - inside;
  return {joints_with(keys_of(ChannelPath::translation, places)), false, {}};
}

// A tenth of its size is allowed.
ShownClip blown_up(double inside) {
  std::vector<Vec3> scales(13, Vec3(1));
  scales[6] = Vec3(1.1 - inside);
  return {joints_with(keys_of(ChannelPath::scale, scales)), false, {}};
}

// Turns to and fro at each key by the same angle on both sides. Four fifths of that angle are its distance from the
// mean of five keys, which may be 2 degrees.
ShownClip shaking(double inside) {
  std::vector<double> angles;
  for (int key = 0; key < 31; ++key) angles.push_back((key % 2 == 0 ? 1.25 : -1.25) * (2.0 * kRadPerDeg - inside));
  return {joints_with(turning_at_30_hz(angles)), false, {}};
}

// One key at rest, between keys that are 10 degrees away.
ShownClip flashing(double inside) {
  std::vector<double> angles(13, 10.0 * kRadPerDeg - inside);
  angles[6] = 0.0;
  return {joints_with(turning_at_30_hz(angles)), false, {}};
}

// Files may be 1 % off.
ShownClip of_length(double inside) {
  ShownClip shown{joints_with(turning_at_30_hz({0.0, 0.0, 0.0})), false, {}};
  shown.asset.faults.push_back({"wave", 2, "gltf.not_unit", "/accessors/0", "", 1, 1.01 - inside});
  return shown;
}

// The left leg moves at its hip from 1 s to 2 s, and stays there.
ShownClip with_leg_moved(const Vec3& way) {
  ShownClip shown{fixtures::person_on_legs(), false, {}, fixtures::kTwoFeet};
  AssetClip clip;
  const auto place = [&](double t_s) { return std::min(std::max(t_s - 1.0, 0.0), 1.0) * way; };
  fixtures::move_node(shown.asset, fixtures::kLeftThigh, place, clip);
  shown.asset.clips.push_back(clip);
  return shown;
}

// A quarter of the leg's length is allowed.
ShownClip with_slide(double inside) { return with_leg_moved({0.25 * fixtures::kLegLength - inside, 0.0, 0.0}); }

// Six hundredths of it are.
ShownClip with_sunken_foot(double inside) { return with_leg_moved({0.0, -0.06 * fixtures::kLegLength + inside, 0.0}); }

const std::map<std::string, std::function<ShownClip(double)>>& clip_exemplars() {
  static const std::map<std::string, std::function<ShownClip(double)>> all = {
      {"loop_seam", gaping},    {"part_gap", pulled_out}, {"translation_pop", out_of_place},
      {"scale_pop", blown_up}, {"jitter", shaking},      {"bind_pose_flash", flashing}, {"quaternion_length", of_length},
      {"foot_slide", with_slide}, {"ground_penetration", with_sunken_foot}};
  return all;
}

ClipEvaluation judged_clip(const ShownClip& shown) {
  const CheckSettings settings;
  const std::vector<ClipFoot>* feet = shown.feet.empty() ? nullptr : &shown.feet;
  return judge_clip({shown.asset, shown.asset.clips[0], settings, shown.is_loop, shown.max_gap_m, feet},
                    {100.0, {}, {}}, nullptr);
}

std::string reason_for(const std::vector<NotJudged>& not_judged, const std::string& check) {
  for (const NotJudged& one : not_judged)
    if (one.check == check) return std::string(one.reason);
  return "";
}

TEST(ClipManifest, EveryCheckOfClipsHasAnExemplarInsideThatPassesAndOneOutsideThatFails) {
  std::size_t seen = 0;
  for (const CheckDef& check : all_checks()) {
    EXPECT_TRUE(check.needs != Needs::clip || check.in_clip != nullptr) << check.name;
    if (check.in_clip == nullptr || check.name == "unreadable_channel") continue;  // it has no margin: see below
    ++seen;
    const auto exemplar = clip_exemplars().find(std::string(check.name));
    ASSERT_NE(exemplar, clip_exemplars().end()) << check.name << " has no exemplar: add one to this file";
    EXPECT_TRUE(judged_clip(exemplar->second(2e-6)).clip_findings.empty()) << check.name;
    const std::vector<KeyFinding> outside = judged_clip(exemplar->second(-2e-6)).clip_findings;
    ASSERT_EQ(outside.size(), 1U) << check.name;
    EXPECT_EQ(outside[0].check, check.name);
    EXPECT_NEAR(outside[0].worst_margin, -2e-6, 1e-9) << check.name;
    EXPECT_NEAR(outside[0].depth, -outside[0].worst_margin / check.scale, 1e-12) << check.name;
  }
  EXPECT_EQ(seen, clip_exemplars().size());
}

TEST(ClipManifest, AChannelThatCannotBeReadNamesItsJointAndReason) {
  ShownClip shown{joints_with(turning_at_30_hz({0.0, 0.0, 0.0})), false, {}};
  EXPECT_TRUE(judged_clip(shown).clip_findings.empty());
  shown.asset.faults = {{"wave", 1, "gltf.bad_times", "/accessors/3", "key 2 is early"},
                        {"other", 1, "gltf.bad_times", "/accessors/4", "of another clip"}};
  const ClipEvaluation out = judged_clip(shown);
  ASSERT_EQ(out.clip_findings.size(), 1U);
  EXPECT_EQ(out.clip_findings[0].check, "unreadable_channel");
  EXPECT_EQ(out.clip_findings[0].subject, "spine");
  EXPECT_EQ(out.clip_findings[0].what, "gltf.bad_times at /accessors/3: key 2 is early");
  EXPECT_EQ(out.channels, 1);
  EXPECT_EQ(out.channel_count, 2);
}

TEST(ClipManifest, EveryCheckEitherJudgesAClipOrSaysWhyNot) {
  const ClipEvaluation out = judged_clip(gaping(0.0));
  EXPECT_EQ(out.judged, (std::vector<JudgedCheck>{{"quaternion_length", 1}, {"angular_velocity", 1}, {"pop", 1}, {"bind_pose_flash", 1},
                                                    {"unreadable_channel", 1}, {"loop_seam", 1}}));
  EXPECT_EQ(out.judged.size() + out.not_judged.size(), all_checks().size());
  EXPECT_EQ(reason_for(out.not_judged, "joint_range"), "no character is given (--character)");
  EXPECT_EQ(reason_for(out.not_judged, "part_gap"),
            "nothing says how far a joint may be from its place (--max-gap-m)");
  EXPECT_EQ(reason_for(judged_clip(pulled_out(0.0)).not_judged, "pop"), "no node turns");
}

Evaluation of_motion() {
  Evaluation motion;
  motion.findings = {{"pop", "arm/elbow", "rad/s", 3, 3, 3, -1.0, 0.1},
                     {"pop", "arm/slide", "m/s", 3, 3, 3, -1.0, 0.1},
                     {"joint_range", "arm/elbow max", "rad", 3, 3, 3, -1.0, 10.0}};
  motion.judged = {{"joint_range", 4}, {"angular_velocity", 2}, {"pop", 2}};
  motion.not_judged = {{"balance", "the motion has no dynamics"}};
  return motion;
}

TEST(ClipManifest, ASpeedIsJudgedOnce) {
  ClipEvaluation out = judged_clip(gaping(0.0));
  add_motion(of_motion(), {{"arm/elbow"}, {}}, out);
  ASSERT_EQ(out.motion_findings.size(), 2U);
  EXPECT_EQ(out.motion_findings[0].subject, "arm/slide");
  EXPECT_EQ(out.motion_findings[1].check, "joint_range");
  EXPECT_EQ(out.judged, (std::vector<JudgedCheck>{
                            {"quaternion_length", 1}, {"joint_range", 4}, {"angular_velocity", 2}, {"pop", 2},
                            {"bind_pose_flash", 1}, {"unreadable_channel", 1}, {"loop_seam", 1}}));
  EXPECT_EQ(reason_for(out.not_judged, "balance"), "the motion has no dynamics");
  EXPECT_EQ(reason_for(out.not_judged, "loop_seam"), "");
}

TEST(ClipManifest, SpeedsOfJointsThatCannotFollowAreNotJudged) {
  ClipEvaluation out = judged_clip(pulled_out(0.0));
  Evaluation motion = of_motion();
  motion.findings.push_back({"angular_acceleration", "arm/slide", "m/s^2", 3, 3, 3, -1.0, 0.1});
  motion.judged.push_back({"angular_acceleration", 2});
  add_motion(motion, {{}, {"arm/slide", "arm/elbow"}}, out);
  ASSERT_EQ(out.motion_findings.size(), 1U);
  EXPECT_EQ(out.motion_findings[0].check, "joint_range");
  for (const char* check : {"angular_velocity", "pop", "angular_acceleration"})
    EXPECT_EQ(reason_for(out.not_judged, check), "no joint can follow its node") << check;
}

}  // namespace
}  // namespace contort
