// The values behind margins: each is compared with the margin that the check itself measured.
#include "checks/measured.h"

#include <gtest/gtest.h>

#include "tests/checks/small_character.h"

namespace contort {
namespace {

class MeasuredTest : public testing::Test {
 protected:
  std::optional<Measured> measured(const char* check, const std::string& subject, double margin,
                                   const CheckSettings& settings = {}) const {
    return measured_of(character_, settings, check, subject, margin);
  }
  Character character_ = small::build();
};

TEST_F(MeasuredTest, SpeedsAreThoseOfTheMotion) {
  Motion motion = small::at_rest(character_, 2);
  small::set(motion, 1, small::joint_of(character_, "arm_left/lift"), 10.0 / 60.0);
  const double margin = small::margin_of("angular_velocity", character_, motion, "arm_left/lift");
  const auto speed = measured("angular_velocity", "arm_left/lift", margin);
  ASSERT_TRUE(speed);
  EXPECT_NEAR(speed->value, 10.0, 1e-9);
  EXPECT_NEAR(speed->limit, 300 * kRadPerDeg, 1e-12);
}

TEST_F(MeasuredTest, AnglesAreThoseOfThePoseAtEitherEnd) {
  Motion motion = small::at_rest(character_, 1);
  for (const auto& [angle, side, limit] : {std::tuple(1.2, " max", 50 * kRadPerDeg), {-0.9, " min", -20 * kRadPerDeg}}) {
    small::set(motion, 0, small::joint_of(character_, "arm_left/lift"), angle);
    const std::string subject = std::string("arm_left/lift") + side;
    const auto found = measured("joint_range", subject, small::margin_of("joint_range", character_, motion, subject));
    ASSERT_TRUE(found) << subject;
    EXPECT_NEAR(found->value, angle, 1e-12);
    EXPECT_NEAR(found->limit, limit, 1e-12);
  }
}

TEST_F(MeasuredTest, DepthsAreThoseOfTheFigure) {
  Motion motion = small::at_rest(character_, 1);
  const std::string body = small::subjects_of("ground_penetration", character_).front();
  const double height = small::margin_of("ground_penetration", character_, motion, body) - 0.005;
  motion.root[0].p_m.y -= height + 0.03;
  const double margin = small::margin_of("ground_penetration", character_, motion, body);
  const auto depth = measured("ground_penetration", body, margin);
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->value, 0.03, 1e-9);
  EXPECT_EQ(depth->limit, 0.005);
  EXPECT_NEAR(measured("self_collision", "a ~ b", -0.02)->value, 0.02, 1e-15);
  EXPECT_NEAR(measured("foot_slide", "a", -0.3)->value, 0.32, 1e-15);
}

TEST_F(MeasuredTest, TolerancesMoveTheLimit) {
  CheckSettings settings;
  settings.limits = {{"joint_range", "* max", "", LimitUse::change, 0.1, "soft stop"}};
  const auto found = measured("joint_range", "arm_left/lift max", -0.2, settings);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->limit, 50 * kRadPerDeg + 0.1, 1e-12);
  EXPECT_NEAR(found->value, 50 * kRadPerDeg + 0.3, 1e-12);
  settings.limits[0].phase = "impact";
  EXPECT_FALSE(measured("joint_range", "arm_left/lift max", -0.2, settings)) << "the frame's phase is not known here";
}

TEST_F(MeasuredTest, GuessesNothing) {
  EXPECT_FALSE(measured("pop", "arm_left/lift", -1.0)) << "its limit depends on the motion";
  EXPECT_FALSE(measured("joint_range", "arm_left/wrist swing", -1.0)) << "an ellipse has no single limit";
  EXPECT_FALSE(measured("joint_range", "arm_left/nowhere max", -1.0));
  EXPECT_FALSE(measured("angular_velocity", "arm_left/nowhere", -1.0));
  EXPECT_FALSE(measured("angular_velocity", "arm_left/lift", std::nan("")));
  EXPECT_FALSE(measured("balance", "whole body", -1.0));
  EXPECT_FALSE(measured("crash", "", -1.0));
}

}  // namespace
}  // namespace contort
