// Feet of a file's own skeleton: slides, sinking feet, and movements that are neither.
#include "checks/clip_feet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "checks/feet_findings.h"
#include "tests/checks/clip_legs.h"

namespace contort {
namespace {

using namespace fixtures;

template <class Place>
ClipFeetFaults faults_where(int node, Place place) {
  const Asset asset = person_on_legs();
  AssetClip clip;
  move_node(asset, node, place, clip);
  return faults_of_feet(asset, clip, kTwoFeet);
}

double ramp(double t_s, double from_s, double to_s) { return std::min(std::max((t_s - from_s) / (to_s - from_s), 0.0), 1.0); }

TEST(ClipFeet, ThatStandHaveNoFault) {
  const ClipFeetFaults none = faults_where(kHips, [](double) { return Vec3(0.0); });
  EXPECT_EQ(none.judged, 2);
  EXPECT_TRUE(none.slides.empty() && none.sinks.empty());
}

TEST(ClipFeet, ThatGlideWithTheFigureSlide) {
  const ClipFeetFaults faults = faults_where(kHips, [](double t_s) { return Vec3(0.3 * t_s, 0.0, 0.0); });
  ASSERT_EQ(faults.slides.size(), 2U);
  EXPECT_NEAR(faults.slides[0].amount, 0.6 / kLegLength, 1e-6) << "in two seconds";
  EXPECT_NEAR(faults.slides[0].leg, kLegLength, 1e-12);
  EXPECT_TRUE(faults.sinks.empty());
}

TEST(ClipFeet, MayCreepABit) {
  EXPECT_TRUE(faults_where(kHips, [](double t_s) { return Vec3(0.2 * ramp(t_s, 1.0, 2.0), 0.0, 0.0); }).slides.empty());
}

TEST(ClipFeet, MayBePutElsewhereAtOnce) {
  const auto quick = [](double t_s) { return Vec3(0.4 * ramp(t_s, 1.0, 1.2), 0.0, 0.0); };
  EXPECT_TRUE(faults_where(kLeftThigh, quick).slides.empty());
  const auto slow = [](double t_s) { return Vec3(0.4 * ramp(t_s, 1.0, 2.0), 0.0, 0.0); };
  EXPECT_EQ(faults_where(kLeftThigh, slow).slides.size(), 1U);
}

TEST(ClipFeet, OfAWalkOnTheSpotAreNotJudged) {
  const Asset asset = person_on_legs();
  AssetClip clip;
  // Half of each second the foot is pulled back on the ground; in the other half it is brought forward in the air.
  const auto stride = [](double t_s) {
    const double phase = t_s - std::floor(t_s);
    const double forward = phase < 0.6 ? 0.3 - phase : -0.3 + 0.6 * (phase - 0.6) / 0.4;
    return Vec3(0.0, phase < 0.6 ? 0.0 : 0.2 * std::sin(3.14159265 * (phase - 0.6) / 0.4), forward);
  };
  move_node(asset, kLeftThigh, stride, clip);
  move_node(asset, kRightThigh, [&](double t_s) { return stride(t_s + 0.5); }, clip);
  const ClipFeetFaults faults = faults_of_feet(asset, clip, kTwoFeet);
  EXPECT_EQ(faults.judged, 2);
  EXPECT_TRUE(faults.slides.empty());
  EXPECT_EQ(faults.no_slide, "the figure walks on the spot");
  move_node(asset, kHips, [](double t_s) { return Vec3(0.0, 0.0, t_s); }, clip);
  EXPECT_TRUE(faults_of_feet(asset, clip, kTwoFeet).slides.empty()) << "it goes where its feet stand";
  clip.channels.pop_back();
  move_node(asset, kHips, [](double t_s) { return Vec3(0.0, 0.0, 2.0 * t_s); }, clip);
  EXPECT_EQ(faults_of_feet(asset, clip, kTwoFeet).slides.size(), 2U) << "it goes twice as far as its feet";
}

TEST(ClipFeet, ThatAreBelowTheGroundOfTheOtherSink) {
  const auto sink = [](double depth_m) {
    return faults_where(kLeftThigh, [=](double t_s) { return Vec3(0.0, -depth_m * std::max(0.0, std::sin(3.0 * t_s)), 0.0); });
  };
  ASSERT_EQ(sink(0.1).sinks.size(), 1U);
  EXPECT_EQ(sink(0.1).sinks[0].foot, 0);
  EXPECT_NEAR(sink(0.1).sinks[0].amount, 0.1 / kLegLength, 0.01);
  EXPECT_TRUE(sink(0.03).sinks.empty());
  const auto down_a_step = [](double t_s) {
    return Vec3(0.0, 0.2 * ramp(t_s, 1.0, 1.1) - 0.35 * ramp(t_s, 1.4, 1.6), 0.4 * ramp(t_s, 1.1, 1.4));
  };
  EXPECT_TRUE(faults_where(kLeftThigh, down_a_step).sinks.empty()) << "the ground may be lower elsewhere";
}

TEST(ClipFeet, ThatSinkOrRiseWithTheWholeFigureDrift) {
  const auto drifts = [](double way_m, double from_s, double to_s) {
    return faults_where(kHips, [=](double t_s) { return Vec3(0.0, way_m * ramp(t_s, from_s, to_s), 0.0); }).drifts;
  };
  for (const double way_m : {-0.2, 0.2})
    for (const double from_s : {0.0, 1.0}) {
      const std::vector<FootFault> found = drifts(way_m, from_s, from_s + 1.0);
      ASSERT_EQ(found.size(), 1U) << way_m << " from " << from_s;
      EXPECT_NEAR(found[0].amount, 0.2 / kLegLength, 1e-6);
    }
  EXPECT_TRUE(drifts(-0.03, 0.0, 1.0).empty()) << "a breath";
  const auto bounce = [](double t_s) { return Vec3(0.0, 0.2 * std::max(0.0, std::sin(3.0 * t_s)) * ramp(2.0 - t_s, 0.0, 0.5), 0.0); };
  EXPECT_TRUE(faults_where(kHips, bounce).drifts.empty()) << "it comes back";
}

TEST(ClipFeet, NeedToBeFoundAndToComeToRest) {
  const Asset asset = person_on_legs();
  AssetClip clip;
  move_node(asset, kHips, [](double t_s) { return Vec3(0.0, std::sin(9.0 * t_s), 0.0); }, clip);
  EXPECT_EQ(faults_of_feet(asset, clip, kTwoFeet).judged, 0) << "it jumps all the time";
  EXPECT_FALSE(faults_of_feet(asset, clip, {kTwoFeet[0]}).why_not.empty());
  clip.last_s = 0.1;
  EXPECT_FALSE(faults_of_feet(asset, clip, kTwoFeet).why_not.empty());
}

TEST(ClipFeet, GiveFindingsThatRulesMove) {
  const Asset asset = person_on_legs();
  AssetClip clip;
  move_node(asset, kHips, [](double t_s) { return Vec3(0.3 * t_s, 0.0, 0.0); }, clip);
  CheckSettings settings;
  ClipInput in{.asset = asset, .clip = clip, .settings = settings, .is_loop = false, .max_gap_m = {}, .feet = &kTwoFeet};
  const ClipCheckResult found = judge_feet_in_clip(in, FootCheck::slide);
  ASSERT_EQ(found.findings.size(), 2U);
  EXPECT_EQ(found.findings[0].subject, "left_foot");
  EXPECT_NEAR(found.findings[0].worst_margin, 0.25 * kLegLength - 0.6, 1e-6);
  EXPECT_EQ(found.findings[0].worst_frame, 120);
  EXPECT_TRUE(judge_feet_in_clip(in, FootCheck::sink).findings.empty());
  in.feet = nullptr;
  EXPECT_EQ(judge_feet_in_clip(in, FootCheck::slide).subjects, 0) << "a character's feet are judged instead";
}

}  // namespace
}  // namespace contort
