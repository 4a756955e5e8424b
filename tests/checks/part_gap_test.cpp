// Joints of clips that leave their places.
#include "checks/part_gap.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

// hips, spine, arm: each is a joint above the next. The arm is 0.3 m from the spine at rest and moves to these places.
Asset arm_at(const std::vector<double>& x_m, int moved = 2) {
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
  AssetChannel channel;
  channel.node = moved;
  for (const double x : x_m) {
    channel.times_s.push_back(0.1 * static_cast<double>(channel.times_s.size()));
    for (const double v : {x, 0.0, 0.0}) channel.values.push_back(v);
  }
  asset.clips.push_back({"wave", "wave", {channel}, 0.0, channel.times_s.back()});
  return asset;
}

std::vector<Finding> gaps(const Asset& asset, const CheckSettings& settings = {}) {
  return check_part_gap(asset, asset.clips[0], 0.01, settings);
}

TEST(PartGap, StaysQuietWithinWhatIsAllowed) { EXPECT_TRUE(gaps(arm_at({0.3, 0.3099, 0.2901, 0.3})).empty()); }

TEST(PartGap, SaysHowFarAndWhen) {
  const std::vector<Finding> found = gaps(arm_at({0.3, 0.311, 0.35, 0.32, 0.3}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].check, "part_gap");
  EXPECT_EQ(found[0].subject, "arm");
  EXPECT_NEAR(found[0].worst_margin, -0.04, 1e-12);
  EXPECT_NEAR(found[0].depth, 2.0, 1e-9);
  EXPECT_EQ(found[0].first_frame, 1);
  EXPECT_EQ(found[0].worst_frame, 2);
  EXPECT_EQ(found[0].last_frame, 3);
}

TEST(PartGap, HipsAndWhatHangsOnTheRootMayMove) {
  EXPECT_TRUE(gaps(arm_at({0.3, 2.0}, 0)).empty());
  EXPECT_TRUE(gaps(arm_at({0.3, 2.0}, 1)).empty());
}

TEST(PartGap, LooksBetweenTheKeysOfSplines) {
  Asset asset = arm_at({0.3, 0.3});
  AssetChannel& channel = asset.clips[0].channels[0];
  channel.interpolation = Interpolation::cubic_spline;
  channel.values = {0, 0, 0, 0.3, 0, 0, 4, 0, 0, -4, 0, 0, 0.3, 0, 0, 0, 0, 0};  // out and back, 4 m/s at the keys
  const std::vector<Finding> found = gaps(asset);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].worst_margin, 0.01 - 0.25 * 0.1 * 4.0, 1e-12);
}

TEST(PartGap, HeedsTheSettings) {
  CheckSettings settings;
  settings.limits = {{"part_gap", "ar*", "", LimitUse::change, 0.05, "r"}};
  EXPECT_TRUE(gaps(arm_at({0.35, 0.35}), settings).empty());
  settings.limits[0].subject = "leg*";
  EXPECT_EQ(gaps(arm_at({0.35, 0.35}), settings).size(), 1U);
}

}  // namespace
}  // namespace contort
