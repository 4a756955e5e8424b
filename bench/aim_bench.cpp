// Measures the time of an aim, and compares it with plain cyclic coordinate descent. First a table: the same 2,000
// reachable directions for each chain, solved by aim() and by CCD from rest without a table, once without any clamp and
// once with every step clamped. Then the benchmarks.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>

#include "checks/check.h"
#include "generator/motion/aim_ik.h"
#include "generator/motion/aim_tables.h"
#include "model/core/detmath.h"
#include "tests/motion/aim_scenes.h"

namespace contort {

namespace {

using fixtures::AimPose;
using fixtures::AimScene;

double angle_between(const Vec3& a, const Vec3& b) {
  const Vec3 across = glm::cross(a, b);
  return det::atan2(std::sqrt(glm::dot(across, across)), glm::dot(a, b));
}

// One step of CCD: Wang and Chen 1991, over directions.
void ccd_step(const Joint& joint, const Rigid& world, const Vec3& facing, const Vec3& wanted, double* q) {
  if (joint.kind == JointKind::ball) {
    const Vec3 turn = glm::conjugate(world.q) * to_rotation_vector(shortest_arc(facing, wanted));
    const Quat turned = glm::normalize(Quat(q[0], q[1], q[2], q[3]) * from_rotation_vector(turn));
    q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
  } else if (joint.kind == JointKind::hinge) {
    const Vec3 axis = world.q * joint.axis;
    const double along = glm::dot(axis, facing) * glm::dot(axis, wanted);
    q[0] += det::atan2(glm::dot(axis, glm::cross(facing, wanted)), glm::dot(facing, wanted) - along);
  }
}

AimResult plain_ccd(const AimScene& scene, const Vec3& wanted, bool clamped, AimPose& pose) {
  constexpr int kMaxSweeps = 48;  // as many as one start of aim() may take
  const int end = static_cast<int>(scene.character.joints().size());
  const auto facing = [&] {
    return world_from_socket(scene.character, pose.world, scene.chain.socket).q * Vec3(0, 0, 1);
  };
  AimResult result{angle_between(facing(), wanted), 0, false};
  for (; result.iterations < kMaxSweeps && result.error_rad > kAimReached_rad; ++result.iterations)
    for (std::size_t i = scene.chain.joints.size(); i-- > 0 && result.error_rad > kAimReached_rad;) {
      const int j = scene.chain.joints[i];
      const Joint& joint = scene.character.joints()[static_cast<std::size_t>(j)];
      double* q = pose.row.data() + joint.coord;
      ccd_step(joint, pose.world[static_cast<std::size_t>(j)], facing(), wanted, q);
      if (clamped) clamp_to_range(joint, q);
      forward_kinematics(scene.character, pose.row, j, end, pose.world);
      result.error_rad = angle_between(facing(), wanted);
    }
  result.reached = result.error_rad <= kAimReached_rad;
  return result;
}

bool violates_range(const Character& character, const std::vector<double>& row) {
  Motion motion;
  motion.coord_count = character.coord_count();
  motion.frame_count = 1;
  motion.coords = row;
  const auto check = std::ranges::find(all_checks(), "joint_range", &CheckDef::name);
  MarginFold fold(check->subject_count(character), 0, check->resolution);
  check->measure({character, motion, {}, {}, {}}, fold);
  return !fold.episodes().empty();
}

using Solve = std::function<AimResult(const Vec3& wanted, AimPose& pose)>;

void compare_row(const char* how, const AimScene& scene, const std::vector<Rigid>& aims, const Solve& solve) {
  std::vector<double> times_us;
  int sweeps = 0, good = 0, violations = 0;
  for (const Rigid& at : aims) {
    AimPose pose(scene.character);
    const Vec3 wanted = fixtures::world_from_base(scene, pose).q * (at.q * Vec3(0, 0, 1));
    const auto start = std::chrono::steady_clock::now();
    const AimResult result = solve(wanted, pose);
    times_us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    sweeps += result.iterations;
    good += result.error_rad <= 0.1 * kRadPerDeg ? 1 : 0;
    violations += violates_range(scene.character, pose.row) ? 1 : 0;
  }
  std::ranges::sort(times_us);
  const auto count = static_cast<double>(aims.size());
  std::printf("%-20s %-12s %7.2f %% %8.2f %12d of %4zu %9.1f %9.1f\n", scene.name.c_str(), how, 100.0 * good / count,
              sweeps / count, violations, aims.size(), times_us[aims.size() / 2], times_us[aims.size() * 99 / 100]);
}

void compare() {
  std::printf("%-20s %-12s %9s %8s %20s %9s %9s\n", "chain", "solver", "<=0.1 deg", "sweeps", "out of range",
              "median us", "p99 us");
  for (const fixtures::AimSceneRow& row : fixtures::kAimScenes) {
    const AimScene scene = fixtures::aim_scene(row);
    const AimTable table = AimTable::build(aim_geometry(scene.character, scene.chain));
    const std::vector<Rigid> aims = fixtures::reachable_aims(table.geometry(), 2000, 1);
    compare_row("aim", scene, aims, [&](const Vec3& wanted, AimPose& pose) {
      return aim(scene.character, scene.chain, table, pose.world, {AimTarget::Kind::direction, wanted}, pose.row);
    });
    for (const bool clamped : {false, true})
      compare_row(clamped ? "CCD clamped" : "CCD free", scene, aims,
                  [&](const Vec3& wanted, AimPose& pose) { return plain_ccd(scene, wanted, clamped, pose); });
  }
}

struct Prepared {
  explicit Prepared(const fixtures::AimSceneRow& row)
      : scene(fixtures::aim_scene(row)),
        table(AimTable::build(aim_geometry(scene.character, scene.chain))),
        aims(fixtures::reachable_aims(table.geometry(), 512, 1)) {}
  AimScene scene;
  AimTable table;
  std::vector<Rigid> aims;
};

void aim_solve(benchmark::State& state, const fixtures::AimSceneRow& row) {
  const Prepared prepared(row);
  AimPose pose(prepared.scene.character);
  const Rigid base = fixtures::world_from_base(prepared.scene, pose);
  std::size_t i = 0;
  for (auto _ : state) {
    const Vec3 wanted = base.q * (prepared.aims[i++ % prepared.aims.size()].q * Vec3(0, 0, 1));
    benchmark::DoNotOptimize(aim(prepared.scene.character, prepared.scene.chain, prepared.table, pose.world,
                                 {AimTarget::Kind::direction, wanted}, pose.row));
  }
}

// A target that moves to and fro by half a degree per call.
void aim_continue(benchmark::State& state, const fixtures::AimSceneRow& row) {
  const Prepared prepared(row);
  AimPose pose(prepared.scene.character);
  const Vec3 start = fixtures::world_from_base(prepared.scene, pose).q * (prepared.aims[0].q * Vec3(0, 0, 1));
  const Vec3 axis_of_way = perpendicular(start);
  int i = 0;
  for (auto _ : state) {
    const int phase = ++i % 20;
    const Vec3 wanted = axis_angle(axis_of_way, 0.5 * kRadPerDeg * (phase < 10 ? phase : 20 - phase)) * start;
    benchmark::DoNotOptimize(continue_aim(prepared.scene.character, prepared.scene.chain, pose.world,
                                          {AimTarget::Kind::direction, wanted}, pose.row));
  }
}

void table_lookup(benchmark::State& state, const fixtures::AimSceneRow& row) {
  const Prepared prepared(row);
  std::array<AimHit, 4> hits;
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(prepared.table.nearest(prepared.aims[i++ % prepared.aims.size()].q * Vec3(0, 0, 1), hits));
}

void table_interpolated(benchmark::State& state, const fixtures::AimSceneRow& row) {
  const Prepared prepared(row);
  std::vector<double> coords(static_cast<std::size_t>(prepared.table.geometry().coord_count));
  std::size_t i = 0;
  for (auto _ : state) {
    prepared.table.interpolated(prepared.aims[i++ % prepared.aims.size()].q * Vec3(0, 0, 1), coords);
    benchmark::DoNotOptimize(coords.data());
  }
}

void table_build(benchmark::State& state, const fixtures::AimSceneRow& row) {
  const AimScene scene = fixtures::aim_scene(row);
  const AimGeometry geometry = aim_geometry(scene.character, scene.chain);
  for (auto _ : state) benchmark::DoNotOptimize(AimTable::build(geometry).posture_count());
}

constexpr fixtures::AimSceneRow kHumanMuzzle = fixtures::kAimScenes[2];
constexpr fixtures::AimSceneRow kMechMuzzle = fixtures::kAimScenes[5];

BENCHMARK_CAPTURE(aim_solve, human_muzzle, kHumanMuzzle)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(aim_solve, mech_slim_muzzle, kMechMuzzle)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(aim_continue, human_muzzle, kHumanMuzzle)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(table_lookup, human_muzzle, kHumanMuzzle);
BENCHMARK_CAPTURE(table_interpolated, human_muzzle, kHumanMuzzle);
BENCHMARK_CAPTURE(table_build, human_muzzle, kHumanMuzzle)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(table_build, mech_slim_muzzle, kMechMuzzle)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace contort

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  contort::compare();
  benchmark::RunSpecifiedBenchmarks();
}
