#include "renders/measured_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/character/character.h"
#include "model/character/library.h"

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

std::string text_of_failed(const Failed& failed) { return failed_text(failed, nullptr, CheckSettings{}); }

TEST(MeasuredText, SaysHowFarBeyondItsLimitASubjectIsIfValueAndLimitAreUnknown) {
  EXPECT_EQ(text_of_failed({"joint_range", "leg/ankle swing", "rad", -1.2741}), "bends 73\u00B0 beyond its swing cone");
  EXPECT_EQ(text_of_failed({"pop", "arm/elbow", "rad/s", -20.1}),
            "jumps 1\u202F150 \u00B0/s faster than its limit and the motion around it allow");
  EXPECT_EQ(text_of_failed({"foot_slide", "leg/foot", "m", -0.0526}), "is 52.6 mm beyond its limit");
  EXPECT_EQ(text_of_failed({"foot_slide", "leg/foot", "m", std::nan("")}), "is not a number");
}

TEST(MeasuredText, SaysTheEventWhereAMarginStandsForOne) {
  EXPECT_EQ(text_of_failed({"balance", "figure", "m", -1.0}), "the figure falls");
  EXPECT_EQ(text_of_failed({"balance", "figure", "m", -0.1}), "the figure is off the ground");
  EXPECT_EQ(text_of_failed({"balance", "figure", "m", -0.05}), "the figure tips over an edge of its feet");
  EXPECT_EQ(text_of_failed({"balance", "figure", "m", -0.06}), "the balance point is 60 mm outside the area under the feet");
}

TEST(MeasuredText, SaysValueAndLimitIfTheCharacterIsKnown) {
  const Result<Character> human = build_character({"human", {}, {}}, stock_library());
  ASSERT_TRUE(human);
  const Failed slide{"foot_slide", "leg_left/foot", "m", -0.0526};
  EXPECT_EQ(failed_text(slide, &*human, CheckSettings{}), "slides 72.6 mm, limit 20 mm");
  const Failed reach{"reach_error", "arm_left/hand", "m", -0.03, true};
  EXPECT_EQ(failed_text(reach, &*human, CheckSettings{}), "is 30 mm beyond its limit");
}

}  // namespace
}  // namespace contort
