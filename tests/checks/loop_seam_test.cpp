// Seams of clips that are played in a loop.
#include "checks/loop_seam.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

// One joint that turns about x to these angles, a key each 1/30 s.
std::vector<Finding> seams(const std::vector<double>& angles_deg, const CheckSettings& settings = {}) {
  Asset asset;
  asset.nodes.resize(1);
  asset.nodes[0].name = asset.nodes[0].label = "knee";
  asset.order = {0};
  AssetChannel channel;
  channel.path = ChannelPath::rotation;
  for (std::size_t key = 0; key < angles_deg.size(); ++key) {
    channel.times_s.push_back(static_cast<double>(key) / 30.0);
    const Quat q = axis_angle(Vec3(1, 0, 0), angles_deg[key] * kRadPerDeg);
    for (const double value : {q.x, q.y, q.z, q.w}) channel.values.push_back(key % 2 == 0 ? value : -value);
  }
  asset.clips.push_back({"walk", "walk", {channel}, 0.0, channel.times_s.back()});
  return check_loop_seam(asset, asset.clips[0], settings);
}

TEST(LoopSeam, ALoopMayRepeatItsFirstKeyOrStopBeforeIt) {
  EXPECT_TRUE(seams({0, 5, 10, 5, 0}).empty());
  EXPECT_TRUE(seams({0, 5, 10, 5}).empty());
  EXPECT_TRUE(seams({0, 0, 0.9}).empty());
}

TEST(LoopSeam, IsAsDeepAsItGapes) {
  EXPECT_TRUE(seams({0, 5, 10, 5, 9.9}).empty()) << "twice the wider of the steps beside it";
  const std::vector<Finding> findings = seams({0, 5, 10, 15, 20});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].subject, "knee");
  EXPECT_NEAR(findings[0].worst_margin, -10.0 * kRadPerDeg, 1e-12);
  EXPECT_EQ(findings[0].worst_frame, 4);
  EXPECT_NEAR(seams({0, 0, 3, 3}).at(0).worst_margin, -2.0 * kRadPerDeg, 1e-12) << "1 degree is always allowed";
}

TEST(LoopSeam, NeedsThreeKeys) { EXPECT_TRUE(seams({0, 90}).empty()); }

TEST(LoopSeam, HeedsTheSettings) {
  CheckSettings settings;
  settings.limits = {{"loop_seam", "kn*", "", LimitUse::change, 11.0 * kRadPerDeg, "r"}};
  EXPECT_TRUE(seams({0, 5, 10, 15, 20}, settings).empty());
}

}  // namespace
}  // namespace contort
