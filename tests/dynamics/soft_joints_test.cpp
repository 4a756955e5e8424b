// Jolts of a target's joints are spread over the time that mass needs.
#include "generator/dynamics/soft_joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "generator/dynamics/leg_fit.h"
#include "generator/dynamics/soft_legs.h"
#include "model/motion/kinematics.h"
#include "model/motion/legs.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

constexpr double kRate_hz = 60.0;
constexpr double kEasy_rad_s2 = 5.0;

struct JoltScene {
  JoltScene() {
    motion.rate_hz = kRate_hz, motion.frame_count = 120, motion.coord_count = human.coord_count();
    motion.root.assign(120, human.rest_root());
    for (int f = 0; f < 120; ++f)
      motion.coords.insert(motion.coords.end(), human.rest_coords().begin(), human.rest_coords().end());
  }
  std::size_t coord(const std::string& joint) const {
    return static_cast<std::size_t>(fixtures::joint(human, joint).coord);
  }
  // Turns from 0 to an angle within a frame.
  void jump(const std::string& joint, double angle_rad) {
    for (int f = 60; f < 120; ++f) motion.row(f)[coord(joint)] = angle_rad;
  }
  bool soften() { return soften_joints(human, legs, easy, motion); }
  void soften_all_legs() { soften_legs(human, figure, legs, {}, easy, motion); }
  double greatest_acceleration(const std::string& joint) const {
    double most = 0.0;
    for (int f = 1; f + 1 < motion.frame_count; ++f)
      most = std::max(most, std::fabs(at(joint, f + 1) - 2.0 * at(joint, f) + at(joint, f - 1)));
    return most * kRate_hz * kRate_hz;
  }
  // Turns evenly from 0 to an angle, from frame 30 to 90: no jolt.
  void turn(const std::string& joint, double angle_rad) {
    for (int f = 0; f < 120; ++f)
      motion.row(f)[coord(joint)] = angle_rad * minimum_jerk(std::clamp((f - 30) / 60.0, 0.0, 1.0));
  }
  // Return the greatest depth of the left foot in the ground, and the distance that its toes move while they touch it.
  double deepest_m() const {
    double deepest = 0.0;
    for (int f = 0; f < 120; ++f)
      for (const Vec3& corner : left_corners_m(f)) deepest = std::max(deepest, -corner.y);
    return deepest;
  }
  double farthest_slide_m() const {
    double farthest = 0.0;
    const std::vector<Vec3> first = left_corners_m(0);
    for (int f = 0; f < 120; ++f) {
      const std::vector<Vec3> now = left_corners_m(f);
      for (std::size_t k = 0; k < now.size(); ++k)
        if (now[k].y < 0.002) farthest = std::max(farthest, length(now[k] - first[k]));
    }
    return farthest;
  }
  std::vector<Vec3> left_corners_m(int frame) const {
    std::vector<Rigid> world(human.joints().size());
    forward_kinematics(human, motion.root[static_cast<std::size_t>(frame)], motion.row(frame), world);
    const Leg& leg = legs[human.parts()[static_cast<std::size_t>(legs[0].part)].slot == "leg_left" ? 0 : 1];
    std::vector<Vec3> corners;
    for (const double x : {leg.low_m.x, leg.high_m.x})
      for (const double z : {leg.low_m.z, leg.high_m.z})
        corners.push_back(world_from_socket(human, world, leg.sole) * Vec3(x, 0.0, z));
    return corners;
  }
  double at(const std::string& joint, int frame) const { return motion.row(frame)[coord(joint)]; }

  const Character& human = fixtures::human();
  const std::vector<Leg> legs = find_legs(human);
  const DynamicFigure figure = build_figure(human, legs, {});
  std::vector<double> easy = std::vector<double>(human.joints().size(), kEasy_rad_s2);
  Motion motion;
};

TEST(SoftJoints, AMotionWithoutJoltsStaysAsItIsBitByBit) {
  JoltScene scene;
  for (int f = 0; f < 120; ++f) scene.motion.row(f)[scene.coord("arm_left/elbow")] = 1.0 - std::cos(0.04 * f);
  const std::vector<double> before = scene.motion.coords;
  EXPECT_FALSE(scene.soften());
  EXPECT_EQ(scene.motion.coords, before);
}

TEST(SoftJoints, AStepBecomesAWayWithinTwiceTheEasyAcceleration) {
  JoltScene scene;
  scene.jump("arm_left/elbow", 0.15);
  ASSERT_GT(scene.greatest_acceleration("arm_left/elbow"), 500.0);
  EXPECT_TRUE(scene.soften());
  EXPECT_LE(scene.greatest_acceleration("arm_left/elbow"), 2.0 * kEasy_rad_s2);
  EXPECT_EQ(scene.at("arm_left/elbow", 0), 0.0);
  EXPECT_EQ(scene.at("arm_left/elbow", 119), 0.15);
  for (int f = 1; f < 120; ++f)
    EXPECT_GE(scene.at("arm_left/elbow", f), scene.at("arm_left/elbow", f - 1) - 1e-12) << f;
}

TEST(SoftJoints, AStepInTheFirstFrameBeginsAtRestAndComesLater) {
  JoltScene scene;
  for (int f = 1; f < 120; ++f) scene.motion.row(f)[scene.coord("arm_left/elbow")] = 0.15;
  EXPECT_TRUE(scene.soften());
  EXPECT_NEAR(scene.at("arm_left/elbow", 0), 0.0, 1e-12);
  EXPECT_EQ(scene.at("arm_left/elbow", 119), 0.15);
  EXPECT_LE(scene.greatest_acceleration("arm_left/elbow"), 3.0 * kEasy_rad_s2);
}

TEST(SoftJoints, AllJointsButThoseOfLegsAreMeansOfTheSameFrames) {
  JoltScene scene;
  scene.jump("arm_left/elbow", 0.2), scene.jump("arm_right/elbow", 0.1), scene.jump("leg_left/knee", 0.2);
  EXPECT_TRUE(scene.soften());
  for (int f = 0; f < 120; ++f) {
    EXPECT_NEAR(scene.at("arm_right/elbow", f), 0.5 * scene.at("arm_left/elbow", f), 1e-12) << f;
    EXPECT_EQ(scene.at("leg_left/knee", f), f < 60 ? 0.0 : 0.2) << "feet must stay where they are, frame " << f;
  }
}

TEST(SoftJoints, ABallTurnsTheShorterWay) {
  JoltScene scene;
  const std::size_t first = scene.coord("arm_left/shoulder");
  for (int f = 60; f < 120; ++f) {  // the same rotation as 0.2 rad about x, with the other sign
    double* q = &scene.motion.row(f)[first];
    q[0] = -std::cos(0.1), q[1] = -std::sin(0.1), q[2] = q[3] = 0.0;
  }
  EXPECT_TRUE(scene.soften());
  for (int f = 0; f < 120; ++f) {
    const double* q = &scene.motion.row(f)[first];
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-12);
    EXPECT_GE(std::fabs(q[0]), std::cos(0.1) - 1e-12) << "never farther from rest than its end, frame " << f;
  }
}

TEST(SoftLegs, ALegThatIsLiftedWithinAFrameIsLiftedOverTime) {
  JoltScene scene;
  scene.jump("leg_left/hip_flex", 0.6), scene.jump("leg_left/knee", 0.9);
  const double jolt = scene.greatest_acceleration("leg_left/knee");
  scene.soften_all_legs();
  EXPECT_LT(scene.greatest_acceleration("leg_left/knee"), 0.05 * jolt);
  EXPECT_EQ(scene.at("leg_left/knee", 0), 0.0);
  EXPECT_EQ(scene.at("leg_left/knee", 119), 0.9);
  EXPECT_EQ(scene.greatest_acceleration("leg_right/knee"), 0.0) << "the other one stands";
}

// The foot swings in over the other one, high enough, and back. Its mean is lower.
TEST(SoftLegs, AMeanThatLeadsThroughTheOtherFootBecomesSmaller) {
  JoltScene scene;
  for (int f = 40; f < 60; ++f) {
    scene.motion.row(f)[scene.coord("leg_left/hip_flex")] = 0.9;
    scene.motion.row(f)[scene.coord("leg_left/knee")] = 0.6;
    scene.motion.row(f)[scene.coord("leg_left/hip_abd")] = f < 42 || f >= 58 ? 0.0 : -0.4;
  }
  LegFit fit(scene.human, scene.figure, scene.legs);
  DynamicsScratch scratch;
  const auto overlaps = [&](int f) { return fit.overlap(3, scene.motion.root[0], scene.motion.row(f), scratch); };
  for (int f = 0; f < 120; ++f) ASSERT_FALSE(overlaps(f)) << "the given motion is clear, frame " << f;
  scene.soften_all_legs();
  for (int f = 0; f < 120; ++f) EXPECT_FALSE(overlaps(f)) << f;
  EXPECT_LT(scene.at("leg_left/hip_abd", 50), -0.01) << "it still goes there, by less";
}

TEST(SoftLegs, AFootThatAPosePointsIntoTheGroundIsRaised) {
  JoltScene scene;
  scene.turn("foot_left/ankle_flex", -0.5);
  ASSERT_GT(scene.deepest_m(), 0.05);
  scene.soften_all_legs();
  EXPECT_LT(scene.deepest_m(), 1e-3);
}

TEST(SoftLegs, AFootThatAPoseWouldDragIsLiftedBeforeItGoes) {
  JoltScene scene;
  scene.turn("leg_left/hip_flex", 0.3);
  scene.turn("leg_left/knee", 0.2);
  scene.turn("foot_left/ankle_flex", -0.1);
  ASSERT_GT(scene.farthest_slide_m(), 0.03);
  scene.soften_all_legs();
  EXPECT_LT(scene.farthest_slide_m(), 0.02);
}

TEST(SoftLegs, AFootThatJumpsAtTheBeginningStartsWhereItStoodAndIsLiftedBeforeItGoes) {
  JoltScene scene;
  const std::vector<Vec3> stood = scene.left_corners_m(0);
  for (int f = 1; f < 120; ++f) {
    scene.motion.row(f)[scene.coord("leg_left/hip_flex")] = 0.4;
    scene.motion.row(f)[scene.coord("leg_left/knee")] = 0.5;
  }
  scene.soften_all_legs();
  EXPECT_NEAR(scene.at("leg_left/hip_flex", 0), 0.0, 1e-9) << "it begins at rest";
  EXPECT_NEAR(scene.at("leg_left/hip_flex", 119), 0.4, 1e-9);
  for (int f = 0; f < 120; ++f) {
    const std::vector<Vec3> now = scene.left_corners_m(f);
    for (std::size_t k = 0; k < now.size(); ++k) {
      EXPECT_GT(now[k].y, -6e-4) << f;
      const double moved_m = std::hypot(now[k].x - stood[k].x, now[k].z - stood[k].z);
      EXPECT_TRUE(moved_m < 0.02 || now[k].y > 0.002) << f;
    }
  }
}

// A walk rests only at its ends, so its intermediate foot places need not be kept.
TEST(SoftLegs, AFootThatHasBeenCarriedElsewhereStaysWhereItIsBitByBit) {
  JoltScene scene;
  for (int f = 0; f < 120; ++f)
    scene.motion.root[static_cast<std::size_t>(f)].p_m.z += 0.5 * minimum_jerk(std::clamp((f - 40) / 20.0, 0.0, 1.0));
  const std::vector<double> before = scene.motion.coords;
  scene.soften_all_legs();
  EXPECT_EQ(scene.motion.coords, before);
}

TEST(SoftLegs, ALegThatStandsWhileItsHipMovesStaysAsItIsBitByBit) {
  JoltScene scene;
  scene.jump("leg_left/hip_flex", 0.6), scene.jump("leg_left/knee", 0.9);
  for (int f = 0; f < 120; ++f) scene.motion.root[static_cast<std::size_t>(f)].p_m.z += 0.001 * f;
  const std::vector<double> before = scene.motion.coords;
  scene.soften_all_legs();
  EXPECT_EQ(scene.motion.coords, before);
}

}  // namespace
}  // namespace contort
