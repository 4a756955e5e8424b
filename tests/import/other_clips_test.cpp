#include "import/other_clips.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

Asset asset_with(const std::vector<std::string>& labels) {
  Asset asset;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    AssetNode node;
    node.name = node.label = labels[i];
    node.parent = static_cast<int>(i) - 1;
    asset.nodes.push_back(node);
    asset.order.push_back(static_cast<int>(i));
  }
  return asset;
}

AssetChannel channel_of(int node, ChannelPath path) {
  AssetChannel channel;
  channel.node = node;
  channel.path = path;
  channel.times_s = {0.0};
  channel.values = path == ChannelPath::rotation ? std::vector<double>{0, 0, 0, 1} : std::vector<double>{1, 2, 3};
  return channel;
}

TEST(OtherClips, TurnsOfNodesWithTheSameNamesAreAdded) {
  Asset model = asset_with({"hips", "arm"});
  Asset library = asset_with({"root", "arm", "hips"});
  AssetClip clip;
  clip.channels = {channel_of(0, ChannelPath::rotation), channel_of(1, ChannelPath::rotation),
                   channel_of(2, ChannelPath::rotation), channel_of(2, ChannelPath::translation)};
  library.clips = {clip};
  EXPECT_EQ(add_clips(library, model), 1);
  ASSERT_EQ(model.clips.size(), 1U);
  ASSERT_EQ(model.clips[0].channels.size(), 2U);
  EXPECT_EQ(model.clips[0].channels[0].node, 1) << "the arm";
  EXPECT_EQ(model.clips[0].channels[1].node, 0) << "the hips";
}

TEST(OtherClips, ClipsForOtherModelsAreLeftOut) {
  Asset model = asset_with({"hips", "arm"});
  Asset library = asset_with({"a", "b", "hips"});
  AssetClip clip;
  for (int node = 0; node < 3; ++node) clip.channels.push_back(channel_of(node, ChannelPath::rotation));
  library.clips = {clip, AssetClip{}};
  EXPECT_EQ(add_clips(library, model), 0);
  EXPECT_TRUE(model.clips.empty());
}

}  // namespace
}  // namespace contort
