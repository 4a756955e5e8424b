// Pops: jumps that the motion around them does not explain.
#include "checks/pop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "checks/check.h"
#include "checks/clip_speed.h"

namespace contort {
namespace {

constexpr double kStep_s = 1.0 / 60.0;

// Intervals of equal length at the given speeds, each marked if it is a pop beyond a limit.
std::string pops(const std::vector<double>& speeds_rad_s, double limit_rad_s = 50.0, double step_s = kStep_s) {
  std::vector<SpeedInterval> intervals;
  for (std::size_t i = 0; i < speeds_rad_s.size(); ++i)
    intervals.push_back({static_cast<double>(i) * step_s, static_cast<double>(i + 1) * step_s, speeds_rad_s[i]});
  std::string out;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double speed = speeds_rad_s[i];
    out += speed <= limit_rad_s ? '.' : speed > explained_rad_s(intervals, i) ? 'P' : '!';
  }
  return out;
}

TEST(Pop, AnIntervalThatStandsOutIsOne) {
  EXPECT_EQ(pops({2, 3, 100, 3, 2}), "..P..");
  EXPECT_EQ(pops({2, 3, 40, 3, 2}), ".....") << "within the limit nothing is reported";
}

TEST(Pop, SoAreTwoInARow) {
  EXPECT_EQ(pops({2, 3, 100, 90, 3, 2}), "..PP..");
  EXPECT_EQ(pops({2, 3, 100, 40, 3, 2}), "..P...") << "there and half the way back";
  EXPECT_EQ(pops({2, 3, 40, 100, 3, 2}), "...P..");
}

TEST(Pop, ThreeInARowAreTooFastInstead) { EXPECT_EQ(pops({2, 3, 100, 100, 100, 3, 2}), "..!!!.."); }

TEST(Pop, ASpeedThatGrowsAndFallsIsExplained) {
  EXPECT_EQ(pops({5, 15, 30, 60, 100, 60, 30, 15, 5}), "...!!!...");
  EXPECT_EQ(pops({20, 20, 70, 20, 20}), "..!..") << "3.5 times its neighbours";
  EXPECT_EQ(pops({20, 20, 90, 20, 20}), "..P..") << "4.5 times its neighbours";
}

TEST(Pop, TheFactorIsTheLimit) {
  EXPECT_EQ(pops({20, kPopFactor * 20 * (1 + 1e-9), 20}), ".P.");
  EXPECT_EQ(pops({20, kPopFactor * 20 * (1 - 1e-9), 20}), ".!.");
}

TEST(Pop, AtTheEndsOneSideIsEnough) {
  EXPECT_EQ(pops({100, 3, 2, 2}), "P...") << "a reference pose in frame 0";
  EXPECT_EQ(pops({100, 100, 3, 2}), "PP..");
  EXPECT_EQ(pops({2, 2, 3, 100}), "...P");
  EXPECT_EQ(pops({100, 80, 60, 2}), "!!!.");
}

TEST(Pop, WithoutNeighboursNothingIsOne) {
  EXPECT_EQ(pops({100}), "!");
  EXPECT_EQ(pops({100, 100}), "!!");
  EXPECT_EQ(pops({100, 3}), "P.");
}

TEST(Pop, SeveralFlipsAreSeveralPops) { EXPECT_EQ(pops({3, 100, 3, 100, 3, 2, 100, 3}), ".P.P..P."); }

TEST(Pop, KeysFarApartAreMovesAndNoJumps) {
  EXPECT_EQ(pops({1, 100, 1}, 50.0, 0.09), ".P.");
  EXPECT_EQ(pops({1, 100, 1}, 50.0, 0.11), ".!.");
  EXPECT_EQ(pops({1, 100, 100, 1}, 50.0, 0.06), ".!!.") << "together 0.12 s";
}

TEST(Pop, BesideAJumpInNoTimeNothingIsExplainedByIt) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(pops({2, inf, 3}), ".P.");
  EXPECT_EQ(pops({2, inf, inf, inf, 3}), ".!!!.");
}

// A clip of one joint that turns about Z by these angles, 60 keys a second.
ClipSpeeds check_angles(const std::vector<double>& angles_rad, double limit_rad_s) {
  Asset asset;
  asset.nodes.push_back({"elbow", "elbow", -1, {}, false});
  asset.order = {0};
  AssetChannel channel;
  channel.path = ChannelPath::rotation;
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    const Quat q = axis_angle(Vec3(0, 0, 1), angles_rad[i]);
    channel.times_s.push_back(static_cast<double>(i) * kStep_s);
    channel.values.insert(channel.values.end(), {q.x, q.y, q.z, q.w});
  }
  asset.clips.push_back({"c", "c", {channel}, 0.0, channel.times_s.back()});
  return check_clip_speeds(asset, {limit_rad_s, {}}).at(0);
}

TEST(Pop, AFindingIsAPopOrTooFastButNeverBoth) {
  // A flip in interval 1, then from interval 5 on a turn that is too fast for four intervals.
  const ClipSpeeds s = check_angles({0, 0, 2, 2, 2, 2, 3, 4, 5, 6, 6}, 50.0);
  ASSERT_EQ(s.findings.size(), 2U);
  EXPECT_EQ(s.findings[0].finding.check, "pop");
  EXPECT_EQ(s.findings[0].finding.first_frame, 1);
  EXPECT_EQ(s.findings[0].finding.last_frame, 1);
  EXPECT_NEAR(s.findings[0].finding.worst_margin, 50.0 - 2.0 / kStep_s, 1e-9);
  EXPECT_NEAR(s.findings[0].finding.depth, (2.0 / kStep_s - 50.0) / find_check("pop").scale, 1e-9);
  EXPECT_EQ(s.findings[1].finding.check, "angular_velocity");
  EXPECT_EQ(s.findings[1].finding.first_frame, 5);
  EXPECT_EQ(s.findings[1].finding.last_frame, 8);
  EXPECT_NEAR(s.least_margin_rad_s, 50.0 - 2.0 / kStep_s, 1e-9);
}

TEST(Pop, ItsMarginIsToWhatIsExplained) {
  // 20 rad/s around it explain 80; the limit of 50 is less.
  const ClipSpeeds s = check_angles({0, 20 * kStep_s, 40 * kStep_s, 140 * kStep_s, 160 * kStep_s}, 50.0);
  ASSERT_EQ(s.findings.size(), 1U);
  EXPECT_EQ(s.findings[0].finding.check, "pop");
  EXPECT_NEAR(s.findings[0].finding.worst_margin, 80.0 - 100.0, 1e-9);
}

}  // namespace
}  // namespace contort
