#include "generator/motion/low_pass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/core/index.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

using fixtures::human;

constexpr int kFrames = 241;
constexpr double kFilterRate_hz = 60.0;

// A motion of the human in which one joint, a ball and the root follow functions of time.
template <typename Angle>
Motion moving(const Character& character, const Angle& angle) {
  Motion motion;
  motion.rate_hz = kFilterRate_hz, motion.frame_count = kFrames, motion.coord_count = character.coord_count();
  motion.coords.resize(at(kFrames) * at(motion.coord_count));
  const Joint& knee = character.joint(character.find_joint("leg_left/knee"));
  const Joint& shoulder = character.joint(character.find_joint("arm_left/shoulder"));
  for (int f = 0; f < kFrames; ++f) {
    const double value = angle(f / kFilterRate_hz);
    const Quat turn = axis_angle(Vec3(0, 0, 1), value);
    std::ranges::copy(character.rest_coords(), motion.row(f).begin());
    motion.row(f)[at(knee.coord)] = value;
    double* ball = &motion.row(f)[at(shoulder.coord)];
    ball[0] = turn.w, ball[1] = turn.x, ball[2] = turn.y, ball[3] = turn.z;
    motion.root.push_back({turn, Vec3(value, 1.0, -value)});
  }
  return motion;
}

// The greatest difference between two motions in frames [first, last].
double difference(const Motion& a, const Motion& b, int first, int last) {
  double most = 0.0;
  for (int f = first; f <= last; ++f) {
    for (std::size_t c = 0; c < a.row(f).size(); ++c) most = std::max(most, std::fabs(a.row(f)[c] - b.row(f)[c]));
    most = std::max(most, length(a.root[at(f)].p_m - b.root[at(f)].p_m));
    most = std::max(most, rotation_angle(glm::conjugate(a.root[at(f)].q) * b.root[at(f)].q));
  }
  return most;
}

TEST(LowPass, KeepsWhatRestsAndWhatMovesEvenlyUpToTheEnds) {
  const Character character = human();
  for (const double speed : {0.0, 0.3}) {
    const Motion given = moving(character, [&](double t_s) { return 0.2 + speed * t_s; });
    Motion filtered = given;
    low_pass(character, 6.0, filtered);
    EXPECT_LT(difference(given, filtered, 0, kFrames - 1), 1e-9) << speed;
  }
}

TEST(LowPass, LeavesOneThroughRootTwoOfItsCutoffWithoutDelay) {
  const Character character = human();
  for (const double hz : {1.0, 6.0, 20.0}) {
    const auto wave = [&](double size) {
      return moving(character, [&](double t_s) { return size * std::sin(2.0 * kPi * hz * t_s); });
    };
    Motion filtered = wave(0.1);
    low_pass(character, 6.0, filtered);
    const double left = std::pow(0.5, 0.5 * (hz / 6.0) * (hz / 6.0));  // a Gaussian's
    EXPECT_LT(difference(wave(0.1 * left), filtered, 30, kFrames - 31), 5e-4) << hz;
  }
}

// The greatest step between two frames, of the knee's angle and of the root's place and rotation.
double greatest_step(const Character& character, const Motion& motion) {
  const int knee = character.joint(character.find_joint("leg_left/knee")).coord;
  double most = 0.0;
  for (int f = 1; f < motion.frame_count; ++f) {
    const Rigid &before = motion.root[at(f - 1)], &now = motion.root[at(f)];
    const double bend = std::fabs(motion.row(f)[at(knee)] - motion.row(f - 1)[at(knee)]);
    const double turn = rotation_angle(glm::conjugate(before.q) * now.q);
    most = std::max({most, bend, length(now.p_m - before.p_m), turn});
  }
  return most;
}

TEST(RemoveJumps, SpreadsAJumpOverTimeAndKeepsBothSides) {
  const Character character = human();
  const Motion given = moving(character, [](double t_s) { return t_s < 2.0 ? 0.0 : 0.3; });
  Motion even = given;
  remove_jumps(character, even);
  EXPECT_GT(greatest_step(character, given), 0.29);
  EXPECT_LT(greatest_step(character, even), 0.06);
  EXPECT_LT(difference(given, even, 0, 60), 1e-6);
  EXPECT_LT(difference(given, even, kFrames - 61, kFrames - 1), 1e-6);
}

TEST(RemoveJumps, LeavesASlowMotionAsItIs) {
  const Character character = human();
  const Motion given = moving(character, [](double t_s) { return 0.3 * std::sin(2.0 * t_s); });
  Motion even = given;
  remove_jumps(character, even);
  EXPECT_LT(difference(given, even, 0, kFrames - 1), 2e-3);
}

}  // namespace
}  // namespace contort
