// Aims, judged by forward kinematics and by the joint_range check.
#include "generator/motion/aim_ik.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "checks/check.h"
#include "generator/motion/aim_tables.h"
#include "model/core/detmath.h"
#include "tests/motion/aim_scenes.h"

namespace contort {
namespace {

using fixtures::aim_scene;
using fixtures::AimPose;
using fixtures::AimScene;
using fixtures::world_from_base;

// Facing against the way to the target, by forward kinematics from scratch.
double true_error_rad(const AimScene& scene, const AimTarget& target, std::span<const double> row) {
  const Character& c = scene.character;
  std::vector<Rigid> world(c.joints().size());
  forward_kinematics(c, c.rest_root(), row, world);
  const Rigid at = world_from_socket(c, world, scene.chain.socket);
  const Vec3 facing = at.q * Vec3(0, 0, 1);
  const Vec3 wanted = target.kind == AimTarget::Kind::point ? target.world - at.p_m : target.world;
  const Vec3 across = glm::cross(facing, wanted);
  return det::atan2(std::sqrt(glm::dot(across, across)), glm::dot(facing, wanted));
}

// The check's smallest margin over all rows and joints; strict, without its allowance for rounding.
double smallest_margin(const Character& character, const std::vector<double>& rows) {
  Motion motion;
  motion.coord_count = character.coord_count();
  motion.frame_count = static_cast<int>(rows.size()) / motion.coord_count;
  motion.coords = rows;
  const auto check = std::ranges::find(all_checks(), "joint_range", &CheckDef::name);
  MarginFold fold(check->subject_count(character), 0);
  const CheckSettings settings;
  const Environment level;
  check->measure({character, motion, {}, settings, level, nullptr}, fold);
  return *std::ranges::min_element(fold.smallest());
}

// Greatest turn of one of the chain's joints between two rows.
double posture_step_rad(const AimScene& scene, std::span<const double> a, std::span<const double> b) {
  double greatest = 0.0;
  for (const int j : scene.chain.joints) {
    const Joint& joint = scene.character.joints()[static_cast<std::size_t>(j)];
    const double* qa = a.data() + joint.coord;
    const double* qb = b.data() + joint.coord;
    if (joint.kind == JointKind::hinge) greatest = std::max(greatest, std::fabs(qa[0] - qb[0]));
    if (joint.kind == JointKind::ball)
      greatest = std::max(greatest, rotation_angle(glm::conjugate(Quat(qa[0], qa[1], qa[2], qa[3])) *
                                                   Quat(qb[0], qb[1], qb[2], qb[3])));
  }
  return greatest;
}

struct Outcome {
  int count = 0;
  int good = 0;  // error <= 0.1 degrees
  double worst_rad = 0.0;
  double iterations = 0.0;
  double margin = 0.0;
};

enum class Targets { directions, far_points, near_points };

AimTarget target_of(Targets targets, const Rigid& aim, double share) {
  const Vec3 facing = aim.q * Vec3(0, 0, 1);
  if (targets == Targets::directions) return {AimTarget::Kind::direction, facing};
  const double distance_m = targets == Targets::far_points ? 2.0 + 18.0 * share : 0.3 + 0.7 * share;
  return {AimTarget::Kind::point, aim.p_m + distance_m * facing};
}

Outcome aim_all(const AimScene& scene, const AimTable& table, Targets targets, int count) {
  Outcome outcome;
  std::vector<double> rows;
  std::mt19937_64 random(5);
  for (const Rigid& base_from_aim : fixtures::reachable_aims(table.geometry(), count, 1)) {
    AimPose pose(scene.character);
    const Rigid aim_world = world_from_base(scene, pose) * base_from_aim;
    const AimTarget target = target_of(targets, aim_world, fixtures::uniform(random, 0, 1));
    const AimResult result = aim(scene.character, scene.chain, table, pose.world, target, pose.row);
    const double error_rad = true_error_rad(scene, target, pose.row);
    EXPECT_NEAR(result.error_rad, error_rad, 1e-9);
    EXPECT_EQ(result.reached, result.error_rad <= kAimReached_rad);
    outcome.count += 1;
    outcome.good += error_rad <= 0.1 * kRadPerDeg ? 1 : 0;
    outcome.worst_rad = std::max(outcome.worst_rad, error_rad);
    outcome.iterations += result.iterations;
    rows.insert(rows.end(), pose.row.begin(), pose.row.end());
  }
  outcome.margin = smallest_margin(scene.character, rows);
  return outcome;
}

void report(const std::string& name, const char* targets, const Outcome& o) {
  std::printf("%-24s %-11s %5d  within 0.1 deg %6.2f %%  worst %8.4f deg  sweeps %6.2f  least margin %.1e\n",
              name.c_str(), targets, o.count, 100.0 * o.good / o.count, o.worst_rad * kDegPerRad,
              o.iterations / o.count, o.margin);
}

class AimIk : public ::testing::TestWithParam<fixtures::AimSceneRow> {};

TEST_P(AimIk, ReachesWhatItsJointsCanReach) {
  const AimScene scene = aim_scene(GetParam());
  ASSERT_FALSE(scene.chain.joints.empty()) << scene.name;
  const AimTable table = AimTable::build(aim_geometry(scene.character, scene.chain));
  const Outcome directions = aim_all(scene, table, Targets::directions, 2000);
  const Outcome far_points = aim_all(scene, table, Targets::far_points, 2000);
  const Outcome near_points = aim_all(scene, table, Targets::near_points, 500);
  report(scene.name, "directions", directions);
  report(scene.name, "2 to 20 m", far_points);
  report(scene.name, "0.3 to 1 m", near_points);
  for (const Outcome& o : {directions, far_points}) EXPECT_GE(o.good, 0.995 * o.count);
  EXPECT_GE(near_points.good, 0.97 * near_points.count);  // nearer than the arm is long: starts may all fail
  for (const Outcome& o : {directions, far_points, near_points}) EXPECT_GE(o.margin, 0.0);
}

struct Followed {
  int lost = 0;   // frames in which the target was not reached
  int stuck = 0;  // number of these for which another posture reaches the target
  double fastest_rad = 0.0;
  std::vector<double> rows;
};

// 100 frames after a target that wanders by half a degree per frame along a great circle. Where it is lost, the next
// frame starts from the table.
void follow(const AimScene& scene, const AimTable& table, int posture, Followed& followed) {
  AimPose pose(scene.character);
  Vec3 wanted = world_from_base(scene, pose).q * table.direction(posture);
  const Quat step = axis_angle(perpendicular(wanted), 0.5 * kRadPerDeg);
  aim(scene.character, scene.chain, table, pose.world, {AimTarget::Kind::direction, wanted}, pose.row);
  for (int frame = 0; frame < 100; ++frame) {
    const std::vector<double> before = pose.row;
    wanted = step * wanted;
    const AimTarget target{AimTarget::Kind::direction, wanted};
    const AimResult result = continue_aim(scene.character, scene.chain, pose.world, target, pose.row);
    EXPECT_NEAR(true_error_rad(scene, target, pose.row), result.error_rad, 1e-9);
    followed.rows.insert(followed.rows.end(), pose.row.begin(), pose.row.end());
    if (result.reached) {
      followed.fastest_rad = std::max(followed.fastest_rad, posture_step_rad(scene, before, pose.row));
    } else {
      ++followed.lost;
      followed.stuck += aim(scene.character, scene.chain, table, pose.world, target, pose.row).reached ? 1 : 0;
    }
  }
}

TEST_P(AimIk, FollowsAMovingTarget) {
  const AimScene scene = aim_scene(GetParam());
  const AimTable table = AimTable::build(aim_geometry(scene.character, scene.chain));
  Followed followed;
  constexpr int kRuns = 30;
  for (int run = 0; run < kRuns; ++run) follow(scene, table, run * (table.posture_count() / kRuns), followed);
  std::printf("%-20s %d frames, %d lost, of these %d stuck; fastest joint %.2f deg per frame\n", scene.name.c_str(),
              100 * kRuns, followed.lost, followed.stuck, followed.fastest_rad * kDegPerRad);
  EXPECT_LE(followed.stuck, 30);
  EXPECT_GE(smallest_margin(scene.character, followed.rows), 0.0);
  EXPECT_LT(followed.fastest_rad, 4.0 * kRadPerDeg);
}

std::string parameter_name(const ::testing::TestParamInfo<fixtures::AimSceneRow>& row) { return row.param.name; }

INSTANTIATE_TEST_SUITE_P(Chains, AimIk, ::testing::ValuesIn(fixtures::kAimScenes), parameter_name);

// A target behind the head: three hinges cannot turn that far. The remaining angle is that of the nearest of 200,000
// postures.
TEST(AimIkEnds, OutOfReachComesAsNearAsItCan) {
  const AimScene scene = aim_scene(fixtures::kAimScenes[13]);
  const AimTable table = AimTable::build(aim_geometry(scene.character, scene.chain));
  std::mt19937_64 random(12);
  std::vector<Vec3> facings;
  for (int i = 0; i < 200000; ++i)
    facings.push_back(base_from_socket(table.geometry(), fixtures::draw_posture(table.geometry(), random)).q *
                      Vec3(0, 0, 1));
  int unreached = 0;
  double worst_excess_rad = 0.0;
  for (int i = 0; i < 300; ++i) {
    const det::SinCos around = det::sincos(fixtures::uniform(random, 0, 2 * kPi));
    const double up = fixtures::uniform(random, -1, 1);
    const Vec3 in_base = Vec3(std::sqrt(1 - up * up) * around.sin, up, std::sqrt(1 - up * up) * around.cos);
    AimPose pose(scene.character);
    const AimTarget target{AimTarget::Kind::direction, world_from_base(scene, pose).q * in_base};
    const AimResult result = aim(scene.character, scene.chain, table, pose.world, target, pose.row);
    EXPECT_GE(smallest_margin(scene.character, pose.row), 0.0);
    if (result.reached) continue;
    ++unreached;
    double best = -1.0;
    for (const Vec3& facing : facings) best = std::max(best, glm::dot(facing, in_base));
    worst_excess_rad = std::max(worst_excess_rad, result.error_rad - det::acos(best));
  }
  std::printf("out of reach: %d of 300; at worst %.2f deg farther off than the best of 200,000 postures\n", unreached,
              worst_excess_rad * kDegPerRad);
  EXPECT_GT(unreached, 50);
  EXPECT_LT(worst_excess_rad, 3.0 * kRadPerDeg);
}

TEST(AimIkEnds, ATargetWithoutDirectionIsNotReachedAndBreaksNothing) {
  const AimScene scene = aim_scene(fixtures::kAimScenes[2]);
  const AimTable table = AimTable::build(aim_geometry(scene.character, scene.chain));
  const double nan = std::nan("");
  for (const Vec3& v : {Vec3(0), Vec3(nan), Vec3(nan, 0, 1)})
    for (const auto kind : {AimTarget::Kind::direction, AimTarget::Kind::point}) {
      if (kind == AimTarget::Kind::point && v == Vec3(0)) continue;
      AimPose pose(scene.character);
      EXPECT_FALSE(aim(scene.character, scene.chain, table, pose.world, {kind, v}, pose.row).reached);
      EXPECT_GE(smallest_margin(scene.character, pose.row), 0.0);
      EXPECT_FALSE(continue_aim(scene.character, scene.chain, pose.world, {kind, v}, pose.row).reached);
      EXPECT_GE(smallest_margin(scene.character, pose.row), 0.0);
    }
}

// Travels stay, and so do all joints outside of the chain.
TEST(AimIkEnds, OnlyTheChainTurns) {
  const AimScene scene = aim_scene(fixtures::kAimScenes[11]);
  const AimTable table = AimTable::build(aim_geometry(scene.character, scene.chain));
  AimPose pose(scene.character);
  const int extend = scene.character.find_joint("arm_right/extend");
  ASSERT_GE(extend, 0);
  const Joint& travel = scene.character.joints()[static_cast<std::size_t>(extend)];
  pose.row[static_cast<std::size_t>(travel.coord)] = 0.25;
  forward_kinematics(scene.character, scene.character.rest_root(), pose.row, pose.world);
  const std::vector<double> before = pose.row;
  const AimTarget target{AimTarget::Kind::point, Vec3(-2, 1, 5)};
  EXPECT_TRUE(aim(scene.character, scene.chain, table, pose.world, target, pose.row).reached);
  for (const Joint& joint : scene.character.joints()) {
    const int index = static_cast<int>(&joint - scene.character.joints().data());
    const bool turns = std::ranges::count(scene.chain.joints, index) > 0 && joint.kind != JointKind::prismatic;
    for (int i = 0; i < coord_size(joint.kind) && !turns; ++i)
      EXPECT_EQ(pose.row[static_cast<std::size_t>(joint.coord + i)], before[static_cast<std::size_t>(joint.coord + i)]);
  }
}

}  // namespace
}  // namespace contort
