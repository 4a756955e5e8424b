// Limits that a skeleton of motion capture declares itself.
#include "checks/dof_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/mocap/amc.h"
#include "formats/mocap/asf.h"
#include "tests/mocap/asf_text.h"
#include "tests/mocap/bvh_text.h"

namespace contort {
namespace {

DofLimits limits_of(const std::string& amc) {
  const Result<AsfSkeleton> skeleton = parse_asf(small_asf());
  const Result<AmcMotion> motion = parse_amc(amc, *skeleton);
  return check_dof_limits(*skeleton, *motion);
}

TEST(DofLimits, SamplesOfLimitedDegreesOfFreedomAreCounted) {
  const DofLimits limits = limits_of(small_amc());
  EXPECT_EQ(limits.samples, 4 * 3) << "arm rx and ry, hand ry; neither the root nor arm rz, which has no limit";
  EXPECT_EQ(limits.out_of_range, 3);
  EXPECT_NEAR(limits.least_margin, -2 * kRadPerDeg, 1e-15);
  EXPECT_NEAR(limits.worst_depth, 20 * kRadPerDeg, 1e-14);
}

TEST(DofLimits, AFindingNamesTheSideAndTheFilesOwnFrames) {
  const std::vector<Finding> findings = limits_of(small_amc()).findings;
  ASSERT_EQ(findings.size(), 3U);
  const auto expect = [&](std::size_t i, const char* subject, int frame, double deg) {
    EXPECT_EQ(findings[i].check, "joint_range");
    EXPECT_EQ(findings[i].subject, subject);
    EXPECT_EQ(findings[i].unit, "rad");
    EXPECT_EQ(findings[i].first_frame, frame) << subject;
    EXPECT_EQ(findings[i].worst_frame, frame) << subject;
    EXPECT_NEAR(findings[i].worst_margin, deg * kRadPerDeg, 1e-14) << subject;
  };
  expect(0, "hand ry max", 7, -1.0);
  expect(1, "arm ry min", 8, -1.5);
  expect(2, "hand ry min", 9, -2.0);
}

TEST(DofLimits, AreInclusiveAndAllowForRounding) {
  const auto out_of_range = [](const char* angle) {
    return limits_of(replaced(small_amc(), "hand 44", std::string("hand ") + angle)).out_of_range - 3;
  };
  EXPECT_EQ(out_of_range("45"), 0);
  EXPECT_EQ(out_of_range("0"), 0);
  EXPECT_EQ(out_of_range("45.0000009"), 0);
  EXPECT_EQ(out_of_range("45.0000011"), 1);
  EXPECT_EQ(out_of_range("-0.0000011"), 1);
}

TEST(DofLimits, FramesInARowAreOneFinding) {
  const DofLimits limits = limits_of(replaced(small_amc(), "hand 44", "hand 50"));
  const auto found = std::find_if(limits.findings.begin(), limits.findings.end(),
                                  [](const Finding& f) { return f.subject == "hand ry max"; });
  ASSERT_NE(found, limits.findings.end());
  EXPECT_EQ(found->first_frame, 7);
  EXPECT_EQ(found->worst_frame, 8);
  EXPECT_EQ(found->last_frame, 8);
}

TEST(DofLimits, WithoutLimitsNothingIsJudged) {
  const Result<AsfSkeleton> skeleton =
      parse_asf(replaced(replaced(small_asf(), "    limits (0.0 45.0)\n", ""),
                         "    limits (-90.0 90.0)\n           (-30.0 30.0)\n           (-inf inf)\n", ""));
  ASSERT_TRUE(skeleton) << to_line(skeleton.issue());
  const DofLimits limits = check_dof_limits(*skeleton, *parse_amc(small_amc(), *skeleton));
  EXPECT_EQ(limits.samples, 0);
  EXPECT_TRUE(limits.findings.empty());
  EXPECT_TRUE(std::isinf(limits.least_margin));
}

}  // namespace
}  // namespace contort
