// BVH: reading of texts made by hand and at random.
#include "formats/mocap/bvh.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <clocale>

#include "formats/mocap/frame.h"
#include "model/asset/sample.h"
#include "tests/corpus/temp_folder.h"
#include "tests/mocap/bvh_text.h"

namespace contort {
namespace {

const Vec3 kAxes[] = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

Asset parsed(const std::string& text) {
  Result<Asset> asset = parse_bvh(text, "clip");
  if (!asset) throw std::runtime_error(to_line(asset.issue()));
  return std::move(asset).value();
}

double apart_rad(const Quat& a, const Quat& b) { return rotation_angle(glm::conjugate(a) * b); }

Quat euler(const std::string& order, const Vec3& deg) {
  Quat q = kNoRotation;
  for (const char axis : order) q = q * axis_angle(kAxes[axis - 'X'], deg[axis - 'X'] * kRadPerDeg);
  return q;
}

TEST(Bvh, NodesAreJointsAndEndSitesInTheFilesOrder) {
  const Asset asset = parsed(small_bvh());
  ASSERT_EQ(asset.nodes.size(), 3U);
  EXPECT_EQ(asset.nodes[0].name, "Hips");
  EXPECT_EQ(asset.nodes[1].name, "rig:Spine one") << "names may hold colons and spaces";
  EXPECT_EQ(asset.nodes[2].name, "rig:Spine one End Site");
  EXPECT_EQ(asset.nodes[0].parent, -1);
  EXPECT_EQ(asset.nodes[1].parent, 0);
  EXPECT_EQ(asset.nodes[2].parent, 1);
  EXPECT_EQ(asset.nodes[0].rest.translation, Vec3(1, 90, -2));
  EXPECT_EQ(asset.nodes[1].rest.translation, Vec3(0.0));
  EXPECT_EQ(asset.nodes[2].rest.translation, Vec3(0, 12.5, 0));
  EXPECT_EQ(asset.order, (std::vector<int>{0, 1, 2}));
}

TEST(Bvh, TheClipHasAKeyForEachFrame) {
  const Asset asset = parsed(small_bvh());
  ASSERT_EQ(asset.clips.size(), 1U);
  const AssetClip& clip = asset.clips[0];
  EXPECT_EQ(clip.name, "clip");
  EXPECT_EQ(clip.last_s, 0.25);
  ASSERT_EQ(clip.channels.size(), 3U);
  for (const AssetChannel& channel : clip.channels) {
    EXPECT_EQ(channel.times_s, (std::vector<double>{0.0, 0.25}));
    EXPECT_EQ(channel.interpolation, Interpolation::linear);
    EXPECT_EQ(channel.values.size(), 2 * row_size(channel.path));
  }
}

TEST(Bvh, RotationsAreTheProductOfTheChannelsAsListed) {
  const Asset asset = parsed(small_bvh());
  const std::vector<Trs> first = pose(asset, asset.clips[0], 0.0);
  const std::vector<Trs> second = pose(asset, asset.clips[0], 0.25);
  EXPECT_LT(apart_rad(first[0].rotation, axis_angle(kAxes[2], kPi / 2)), 1e-15);
  EXPECT_LT(apart_rad(second[0].rotation, euler("ZYX", Vec3(90, 90, 0))), 1e-15);
  EXPECT_LT(apart_rad(second[1].rotation, euler("XYZ", Vec3(90, 90, 0))), 1e-15) << "each joint has its own order";
  EXPECT_GT(apart_rad(second[0].rotation, second[1].rotation), 1.0);
}

TEST(Bvh, PositionsAreAddedToTheOffset) {
  const Asset asset = parsed(small_bvh());
  EXPECT_EQ(pose(asset, asset.clips[0], 0.0)[0].translation, Vec3(11, 110, 28));
  EXPECT_EQ(pose(asset, asset.clips[0], 0.25)[0].translation, Vec3(0.9, 90.5, 1));
  EXPECT_EQ(pose(asset, asset.clips[0], 0.25)[1].translation, Vec3(0.0));
}

// ---- positions on any joint

// A root and two bones, 98 high and 27 and 25 long at rest, with the given offsets and one line for each frame.
std::string six_channels(const std::string& root, const std::string& bone, const std::vector<std::string>& frames) {
  const std::string channels = "\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
  std::string text = "HIERARCHY\nROOT hips\n{\nOFFSET " + root + channels + "JOINT arm\n{\nOFFSET " + bone + channels +
                     "JOINT hand\n{\nOFFSET " + bone + channels + "}\n}\n}\nMOTION\nFrames: " +
                     std::to_string(frames.size()) + "\nFrame Time: 0.02\n";
  for (const std::string& frame : frames) text += frame + "\n";
  return text;
}

Vec3 place(const Asset& asset, std::size_t node, int frame) {
  return pose(asset, asset.clips[0], frame * 0.02)[node].translation;
}

bool has_remark(const Asset& asset, const std::string& code, const std::string& part) {
  return std::ranges::any_of(asset.remarks, [&](const Remark& remark) {
    return remark.code == code && remark.text.find(part) != std::string::npos;
  });
}

TEST(Bvh, PositionsNearTheOffsetsReplaceThem) {
  const Asset asset = parsed(six_channels(
      "0 98 0", "27 0 0",
      {"0 98 0 0 0 0 27 0 0 0 0 0 27 0 0 0 0 0", "5 10 300 0 0 0 27 0 0 0 0 9 39 0 0 0 0 0"}));
  EXPECT_EQ(place(asset, 0, 0), Vec3(0, 98, 0));
  EXPECT_EQ(place(asset, 0, 1), Vec3(5, 10, 300)) << "the root goes with the joints below it";
  EXPECT_EQ(place(asset, 1, 0), Vec3(27, 0, 0));
  EXPECT_EQ(place(asset, 2, 1), Vec3(39, 0, 0));
  EXPECT_TRUE(has_remark(asset, "bvh.positions", "3 joints replace OFFSET"));
  EXPECT_TRUE(asset.nodes[2].is_joint) << "gaps between joints can be judged";
}

TEST(Bvh, PositionsNearZeroAreAdded) {
  const Asset asset = parsed(six_channels(
      "0 98 0", "27 0 0", {"1 2 3 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0", "1 2 300 0 0 0 0.5 0 0 0 0 9 12 0 0 0 0 0"}));
  EXPECT_EQ(place(asset, 0, 1), Vec3(1, 100, 300));
  EXPECT_EQ(place(asset, 1, 1), Vec3(27.5, 0, 0));
  EXPECT_EQ(place(asset, 2, 1), Vec3(39, 0, 0));
  EXPECT_TRUE(has_remark(asset, "bvh.positions", "3 joints are added to OFFSET"));
}

// LAFAN1: the first frame equals OFFSET, and the root travels far. In other files the height decides.
TEST(Bvh, ARootAloneIsToldByItsFirstFrameOrItsHeight) {
  const auto with_root = [](const std::string& frames) {
    const std::string hips = "ROOT hips\n{\nOFFSET 134 91 22\nCHANNELS 3 Xposition Yposition Zposition\n}\n";
    return parsed("HIERARCHY\n" + hips + "MOTION\nFrames: 2\nFrame Time: 0.02\n" + frames);
  };
  EXPECT_EQ(place(with_root("134 91 22\n-300 85 -90\n"), 0, 1), Vec3(-300, 85, -90));
  EXPECT_EQ(place(with_root("20 89 2\n-300 85 -90\n"), 0, 1), Vec3(-300, 85, -90));
  EXPECT_EQ(place(with_root("0 0 0\n-300 -5 -90\n"), 0, 1), Vec3(-166, 86, -68));
}

TEST(Bvh, BonesWithoutOffsetsRestAtTheFirstFrame) {
  const Asset asset = parsed(six_channels(
      "0 0 0", "0 0 0", {"0 98 0 0 0 0 27 0 0 0 0 0 25 0 0 0 0 0", "0 98 9 0 0 0 27 0 0 0 0 0 37 0 0 0 0 0"}));
  EXPECT_EQ(asset.nodes[0].rest.translation, Vec3(0.0));
  EXPECT_EQ(asset.nodes[1].rest.translation, Vec3(27, 0, 0));
  EXPECT_EQ(place(asset, 2, 1), Vec3(37, 0, 0));
  EXPECT_TRUE(has_remark(asset, "bvh.no_offsets", "first frame"));
}

TEST(Bvh, AxesWithoutAChannelStayAtTheOffset) {
  const std::string text = "HIERARCHY\nROOT hips\n{\nOFFSET 5 91 7\nCHANNELS 1 Yposition\n}\nMOTION\nFrames: 2\n";
  EXPECT_EQ(place(parsed(text + "Frame Time: 0.02\n90\n92\n"), 0, 1), Vec3(5, 92, 7));
  EXPECT_EQ(place(parsed(text + "Frame Time: 0.02\n0\n2\n"), 0, 1), Vec3(5, 93, 7));
}

// ---- faults of exporters

TEST(Bvh, TheLinesCountAndNotWhatTheFileSaysOfThem) {
  const Asset plain = parsed(small_bvh());
  for (const std::string said : {"1", "3", "0", "900000"}) {
    const Asset asset = parsed(replaced(small_bvh(), "Frames: 2", "Frames: " + said));
    EXPECT_EQ(asset.clips, plain.clips) << said;
    EXPECT_TRUE(has_remark(asset, "bvh.frame_count", "Frames: says " + said + ", and the file has 2 lines")) << said;
  }
  EXPECT_FALSE(has_remark(plain, "bvh.frame_count", ""));
}

TEST(Bvh, ALastLineThatBreaksOffIsLeftOut) {
  const Asset asset = parsed(replaced(small_bvh(), "90 90 0\n", "90\n"));
  EXPECT_EQ(asset.clips[0].channels[0].times_s.size(), 1U);
  EXPECT_TRUE(has_remark(asset, "bvh.cut_frame", "7 of 9 numbers"));
}

TEST(Bvh, FrameTimesThatNoCameraHasAreRemarked) {
  EXPECT_TRUE(has_remark(parsed(replaced(small_bvh(), "0.25", "33.3")), "bvh.frame_time", "--rate-hz"));
  EXPECT_TRUE(has_remark(parsed(replaced(small_bvh(), "0.25", "0.00001")), "bvh.frame_time", "--rate-hz"));
  EXPECT_FALSE(has_remark(parsed(replaced(small_bvh(), "0.25", "0.0333333")), "bvh.frame_time", ""));
}

TEST(Bvh, ARateFromOutsideCountsInsteadOfTheFrameTime) {
  for (const std::string time : {"0", "nan", "33.3"}) {
    const Result<Asset> asset = parse_bvh(replaced(small_bvh(), "0.25", time), "", 50.0);
    ASSERT_TRUE(asset.ok()) << time;
    EXPECT_EQ(asset->clips[0].last_s, 0.02) << time;
    EXPECT_TRUE(has_remark(*asset, "bvh.frame_time", "at 50 per second")) << time;
  }
}

TEST(Bvh, ValuesMayFollowTheirLabelsWithoutABlank) {
  const std::string text = replaced(replaced(small_bvh(), "Frames: 2", "Frames:2"), "Time: 0.25", "Time:0.25");
  EXPECT_EQ(parsed(text), parsed(small_bvh()));
}

TEST(Bvh, UnitsAndAxesFromOutsideGoToAllLengthsAndRoots) {
  Asset asset = parsed(replaced(small_bvh(), "0.25", "0.02"));
  const Asset plain = asset;
  scale_lengths(0.01, asset);
  turn_z_up(asset);
  const Vec3 before = place(plain, 0, 0), after = place(asset, 0, 0);
  EXPECT_LT(glm::length(after - 0.01 * Vec3(before.x, before.z, -before.y)), 1e-12);
  EXPECT_LT(glm::length(asset.nodes[0].rest.translation - Vec3(0.01, -0.02, -0.9)), 1e-12);
  EXPECT_EQ(asset.nodes[2].rest.translation, Vec3(0, 0.125, 0)) << "joints below a root turn with it";
  const Quat turn = axis_angle(kAxes[0], -0.5 * kPi);
  EXPECT_LT(apart_rad(asset.nodes[0].rest.rotation, turn), 1e-12);
  EXPECT_LT(apart_rad(pose(asset, asset.clips[0], 0.0)[0].rotation, turn * axis_angle(kAxes[2], kPi / 2)), 1e-12);
}

TEST(Bvh, HowLinesEndDoesNotMatter) {
  const Asset plain = parsed(small_bvh());
  std::string crlf;
  for (const char c : small_bvh()) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(parsed(crlf), plain);
  std::string unfinished = small_bvh();
  unfinished.pop_back();
  EXPECT_EQ(parsed(unfinished), plain);
  EXPECT_EQ(parsed("\xef\xbb\xbf\n\n" + small_bvh() + "  \n\t\r\n"), plain);
  EXPECT_EQ(parsed(replaced(replaced(small_bvh(), "Hips\n{", "Hips {"), "Frame Time: ", "Frame Time:\t")), plain);
}

TEST(Bvh, TheLocaleDoesNotMatter) {
  const Asset plain = parsed(small_bvh());
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) std::setlocale(LC_ALL, "C.UTF-8");
  EXPECT_EQ(parsed(small_bvh()), plain);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Bvh, EqualAndEmptyNamesGetLabelsOfTheirOwn) {
  const Asset asset = parsed(replaced(replaced(small_bvh(), "rig:Spine one", "Hips"), "ROOT Hips", "ROOT"));
  EXPECT_EQ(asset.nodes[0].name, "");
  EXPECT_EQ(asset.nodes[0].label, "#0");
  EXPECT_EQ(asset.nodes[1].label, "Hips");
}

TEST(Bvh, NoFramesAreASkeletonWithoutAClip) {
  std::string text = small_bvh();
  text = replaced(text.substr(0, text.find("90 0 0")), "Frames: 2", "Frames: 0");
  EXPECT_TRUE(parsed(text).clips.empty());
  EXPECT_EQ(parsed(text).nodes, parsed(small_bvh()).nodes);
}

TEST(Bvh, AFileGivesItsNameToTheClip) {
  const TempFolder folder;
  spill(folder / "walk 01.bvh", small_bvh());
  const Result<Asset> asset = read_bvh(folder / "walk 01.bvh");
  ASSERT_TRUE(asset) << to_line(asset.issue());
  EXPECT_EQ(asset->clips[0].label, "walk 01");
}

// ---- a random skeleton and motion, written and read back

struct RandomJoint {
  int depth = 0;
  std::size_t order = 0;
  std::vector<Vec3> deg;  // by frame
};

const std::array<std::string, 6> kOrders = {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"};

std::string hundredths(int value) {
  return (value < 0 ? "-" : "") + std::to_string(std::abs(value) / 100) + "." +
         std::to_string(std::abs(value) % 100 + 100).substr(1);
}

// Joints are nested by depth; each is closed before the next one that is not deeper.
std::string to_text(const std::vector<RandomJoint>& joints, int frames) {
  std::string text = "HIERARCHY\n";
  std::vector<int> open;
  const auto close_to = [&](int depth) {
    for (; !open.empty() && open.back() >= depth; open.pop_back()) text += "}\n";
  };
  for (const RandomJoint& joint : joints) {
    close_to(joint.depth);
    text += (open.empty() ? "ROOT j\n{\nOFFSET 0 1 0\nCHANNELS 3" : "JOINT j\n{\nOFFSET 0 1 0\nCHANNELS 3");
    for (const char axis : kOrders[joint.order]) text += std::string(" ") + axis + "rotation";
    text += "\n";
    open.push_back(joint.depth);
  }
  close_to(0);
  text += "MOTION\nFrames: " + std::to_string(frames) + "\nFrame Time: 0.01\n";
  for (int frame = 0; frame < frames; ++frame, text += "\n")
    for (const RandomJoint& joint : joints)
      for (const char axis : kOrders[joint.order])
        text += " " + hundredths(static_cast<int>(joint.deg[static_cast<std::size_t>(frame)][axis - 'X'] * 100.0));
  return text;
}

RandomJoint random_joint(bool is_root, int frames) {
  RandomJoint joint;
  joint.depth = is_root ? 0 : *rc::gen::inRange(1, 5);
  joint.order = *rc::gen::inRange<std::size_t>(0, kOrders.size());
  for (int frame = 0; frame < frames; ++frame) {
    Vec3 deg(0.0);
    for (int i = 0; i < 3; ++i) deg[i] = *rc::gen::inRange(-1440, 1440) * 0.25;
    joint.deg.push_back(deg);
  }
  return joint;
}

RC_GTEST_PROP(BvhProperty, WhatIsWrittenIsReadBack, ()) {
  const int frames = *rc::gen::inRange(1, 5);
  const int count = *rc::gen::inRange(1, 8);
  std::vector<RandomJoint> joints;
  for (int i = 0; i < count; ++i) joints.push_back(random_joint(i == 0, frames));
  const Result<Asset> asset = parse_bvh(to_text(joints, frames), "random");
  RC_ASSERT(asset.ok());
  RC_ASSERT(asset->nodes.size() == joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (int frame = 0; frame < frames; ++frame) {
      const AssetChannel& channel = asset->clips[0].channels[i];
      const Quat q = sample_rotation(channel, channel.times_s[static_cast<std::size_t>(frame)]);
      const Quat expected = euler(kOrders[joints[i].order], joints[i].deg[static_cast<std::size_t>(frame)]);
      RC_ASSERT(std::abs(glm::length(q) - 1.0) < 1e-15 * 4);
      RC_ASSERT(apart_rad(q, expected) < 1e-12);
    }
}

}  // namespace
}  // namespace contort
