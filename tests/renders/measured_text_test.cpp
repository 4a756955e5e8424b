#include "renders/measured_text.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

TEST(MeasuredText, SaysValueAndLimitInFamiliarUnits) {
  EXPECT_EQ(measured_text("angular_velocity", "rad/s", {62.832, 12.793}),
            "turns 3\u202F600 \u00B0/s, limit 733 \u00B0/s");
  EXPECT_EQ(measured_text("angular_velocity", "m/s", {3.0, 2.0}), "moves 3 m/s, limit 2 m/s");
  EXPECT_EQ(measured_text("foot_slide", "m", {0.24, 0.02}), "slides 240 mm, limit 20 mm");
  EXPECT_EQ(measured_text("foot_slide", "m", {2.4, 0.02}), "slides 2.4 m, limit 20 mm");
  EXPECT_EQ(measured_text("joint_range", "rad", {2.1, 1.5}), "is at 120\u00B0, limit 85.9\u00B0");
  EXPECT_EQ(measured_text("joint_torque", "of its strength", {34.5, 1.0}),
            "needs 3\u202F450 % of its strength, limit 100 %");
  EXPECT_EQ(measured_text("angular_acceleration", "rad/s^2", {100.0, 50.0}),
            "changes its speed by 5\u202F730 \u00B0/s^2, limit 2\u202F860 \u00B0/s^2");
}

}  // namespace
}  // namespace contort
