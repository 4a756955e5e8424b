// Real motion capture from other people: shared/assets beside the repository. Skipped if it is missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "checks/clip_speed.h"
#include "checks/dof_limits.h"
#include "formats/mocap/amc.h"
#include "formats/mocap/asf.h"
#include "formats/mocap/bvh.h"
#include "model/asset/sample.h"

namespace contort {
namespace {

const std::string kAssets = std::string(CONTORT_SOURCE_DIR) + "/../shared/assets/";

#define SKIP_WITHOUT_ASSETS() \
  if (!std::filesystem::exists(kAssets + "MANIFEST.tsv")) GTEST_SKIP() << "no folder " << kAssets

// The default of contort check.
const SpeedLimits kLimits{3000.0 * kRadPerDeg, {}};

// A row of the manifest: path and the last column, facts that someone else's parser measured.
struct BvhFacts {
  std::string path;
  std::string text;
};

std::vector<BvhFacts> bvh_facts() {
  std::vector<BvhFacts> out;
  std::ifstream file(kAssets + "MANIFEST.tsv");
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, '\t');) fields.push_back(field);
    if (fields.size() > 10 && fields[1] == "mocap-bvh") out.push_back({fields[0], fields[10]});
  }
  return out;
}

// The number that stands before a text, as 31 in "31 joints (+7 end sites), 96 channels".
double number_before(const std::string& facts, const std::string& what) {
  const std::size_t end = facts.find(what);
  const std::size_t start = facts.find_last_not_of("0123456789.", end - 1) + 1;
  return std::stod(facts.substr(start, end - start));
}

ClipSpeeds speeds_of(const Asset& asset) { return check_clip_speeds(asset, kLimits).at(0); }

// The speed of a joint between a frame and the next one, deg/s; -1 if the file does not animate the joint.
double speed_at(const Asset& asset, const std::string& joint, std::size_t frame) {
  for (const ChannelSpeeds& speeds : joint_speeds(asset.clips[0]))
    if (asset.nodes[static_cast<std::size_t>(speeds.node)].name == joint && frame < speeds.between_keys.size())
      return speeds.between_keys[frame].speed_rad_s * kDegPerRad;
  return -1.0;
}

TEST(MocapAssets, EveryBvhHasTheFactsOfTheManifest) {
  SKIP_WITHOUT_ASSETS();
  const std::vector<BvhFacts> all = bvh_facts();
  EXPECT_EQ(all.size(), 14U);
  for (const auto& [path, facts] : all) {
    const Result<Asset> asset = read_bvh(kAssets + path);
    ASSERT_TRUE(asset) << path << ": " << to_line(asset.issue());
    const double nodes = number_before(facts, " joints") + number_before(facts, " end sites");
    EXPECT_EQ(static_cast<double>(asset->nodes.size()), nodes) << path;
    EXPECT_EQ(static_cast<double>(asset->clips[0].channels[0].times_s.size()), number_before(facts, " frames")) << path;
    const ClipSpeeds speeds = speeds_of(*asset);
    const double peak_deg_s = number_before(facts, " deg/s");
    EXPECT_NEAR(speeds.peak_rad_s * kDegPerRad, peak_deg_s, 1.0) << path;
    // The text has the form "peak 60 deg/s @ child2 frame 4". Other intervals may be equally fast, so the named one is
    // measured.
    const std::size_t joint = facts.find(" deg/s @ ") + 9;
    const std::size_t frame = facts.find(" frame ", joint);
    EXPECT_NEAR(speed_at(*asset, facts.substr(joint, frame - joint), std::stoul(facts.substr(frame + 7))), peak_deg_s,
                1.0)
        << path;
  }
}

int count_of(const ClipSpeeds& speeds, const std::string& check) {
  return static_cast<int>(std::count_if(speeds.findings.begin(), speeds.findings.end(),
                                        [&](const ClipFinding& f) { return f.finding.check == check; }));
}

const ClipFinding* find_worst(const ClipSpeeds& speeds) {
  const auto worst = std::max_element(
      speeds.findings.begin(), speeds.findings.end(),
      [](const ClipFinding& l, const ClipFinding& r) { return l.worst_speed_rad_s < r.worst_speed_rad_s; });
  return worst == speeds.findings.end() ? nullptr : &*worst;
}

// Clips with a reference pose in frame 0: that is all that is wrong with them.
TEST(MocapAssets, ReferencePosesInFrame0ArePopsAndNothingElseIsFound) {
  SKIP_WITHOUT_ASSETS();
  struct Row {
    const char* file;
    const char* joint;
    double deg_s;
  };
  for (const Row& row :
       {Row{"cmu_cgspeed/01_01.bvh", "LeftForeArm", 16348}, Row{"pybvh/cmu_12_01_walk.bvh", "RightArm", 9927}}) {
    const Result<Asset> asset = read_bvh(kAssets + "mocap/bvh/" + row.file);
    ASSERT_TRUE(asset) << to_line(asset.issue());
    const ClipSpeeds speeds = speeds_of(*asset);
    ASSERT_FALSE(speeds.findings.empty());
    for (const ClipFinding& f : speeds.findings) {
      EXPECT_EQ(f.finding.check, "pop") << row.file << " " << f.finding.subject;
      EXPECT_EQ(f.finding.first_frame, 0);
      EXPECT_EQ(f.finding.last_frame, 0);
    }
    const ClipFinding* worst = find_worst(speeds);
    EXPECT_EQ(worst->finding.subject, row.joint);
    EXPECT_NEAR(worst->worst_speed_rad_s * kDegPerRad, row.deg_s, 1.0);
  }
}

// A solver that flips legs repeatedly: nearly every movement that is too fast here is over after a frame or two.
TEST(MocapAssets, FlipsOfASolverArePops) {
  SKIP_WITHOUT_ASSETS();
  const Result<Asset> asset = read_bvh(kAssets + "mocap/bvh/cmu_iclone/005_06.bvh");
  ASSERT_TRUE(asset) << to_line(asset.issue());
  const ClipSpeeds speeds = speeds_of(*asset);
  const ClipFinding* worst = find_worst(speeds);
  ASSERT_NE(worst, nullptr);
  EXPECT_EQ(worst->finding.check, "pop");
  EXPECT_EQ(worst->finding.subject, "CC_Base_L_CalfTwist02");
  EXPECT_EQ(worst->finding.worst_frame, 231);
  EXPECT_NEAR(worst->worst_speed_rad_s * kDegPerRad, 10764, 1.0);
  EXPECT_EQ(count_of(speeds, "pop"), 77);
  EXPECT_EQ(count_of(speeds, "angular_velocity"), 8);
}

TEST(MocapAssets, AllOtherClipsAreQuiet) {
  SKIP_WITHOUT_ASSETS();
  for (const BvhFacts& facts : bvh_facts()) {
    if (facts.path.ends_with("/01_01.bvh") || facts.path.ends_with("12_01_walk.bvh")) continue;
    if (facts.path.ends_with("005_06.bvh")) continue;
    const Result<Asset> asset = read_bvh(kAssets + facts.path);
    ASSERT_TRUE(asset);
    EXPECT_TRUE(speeds_of(*asset).findings.empty()) << facts.path;
  }
}

// Counted by someone else's parser too. Frames are numbered as in the file, from 1.
TEST(MocapAssets, CmuMotionsLeaveTheLimitsOfTheirOwnSkeleton) {
  SKIP_WITHOUT_ASSETS();
  struct Row {
    const char* file;
    std::int64_t out_of_range, samples;
    double worst_deg;
    int frame;
  };
  const Result<AsfSkeleton> skeleton = read_asf(kAssets + "mocap/asfamc/02.asf");
  ASSERT_TRUE(skeleton) << to_line(skeleton.issue());
  for (const Row& row : {Row{"02_01.amc", 863, 19208, 29.7, 191}, Row{"02_04.amc", 1193, 27048, 32.0, 94}}) {
    const Result<AmcMotion> motion = read_amc(kAssets + "mocap/asfamc/" + row.file, *skeleton);
    ASSERT_TRUE(motion) << to_line(motion.issue());
    const DofLimits limits = check_dof_limits(*skeleton, *motion);
    EXPECT_EQ(limits.samples, row.samples);
    EXPECT_EQ(limits.out_of_range, row.out_of_range);
    EXPECT_NEAR(-limits.least_margin * kDegPerRad, row.worst_deg, 0.05);
    const auto worst = std::max_element(limits.findings.begin(), limits.findings.end(),
                                        [](const Finding& l, const Finding& r) { return l.depth < r.depth; });
    ASSERT_NE(worst, limits.findings.end());
    EXPECT_EQ(worst->subject, "lwrist ry max");
    EXPECT_EQ(worst->worst_frame, row.frame);
  }
}

TEST(MocapAssets, CmuMotionsAreNotTooFastAt120Hz) {
  SKIP_WITHOUT_ASSETS();
  const Result<AsfSkeleton> skeleton = read_asf(kAssets + "mocap/asfamc/02.asf");
  ASSERT_TRUE(skeleton);
  for (const char* file : {"02_01.amc", "02_04.amc"}) {
    const Result<AmcMotion> motion = read_amc(kAssets + "mocap/asfamc/" + file, *skeleton);
    ASSERT_TRUE(motion);
    const ClipSpeeds speeds = speeds_of(to_asset(*skeleton, *motion, 120.0, file));
    EXPECT_EQ(speeds.channels, 29) << file;
    EXPECT_TRUE(speeds.findings.empty()) << file << " " << speeds.peak_node << " " << speeds.peak_rad_s * kDegPerRad;
  }
}

}  // namespace
}  // namespace contort
