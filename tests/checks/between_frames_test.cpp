// Between two frames: bodies that pass through each other are found, and no overlap deeper than a millimetre is missed.
#include "checks/between_frames.h"

#include <gtest/gtest.h>

#include "tests/checks/small_character.h"
#include "tests/geometry/solids.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

using test_solids::Random;

const char* const kRodAndPost = "arm_left/lift ~ base";

// A thin rod on the left arm's hinge, and a thin post on the base that it sweeps across.
Character with_rod_and_post() {
  Library library = small::library();
  library.parts["small_arm"].colliders = {{"rod", "lift", Capsule{{0, 0, 0}, {0.5, 0, 0}, 0.01}}};
  library.parts["small_base"].colliders = {{"post", "", Capsule{{0.9, 0, -0.3}, {0.9, 0, 0.3}, 0.02}}};
  return small::build(library);
}

Motion swept(const Character& character, std::initializer_list<double> angles_rad) {
  Motion motion = small::at_rest(character, static_cast<int>(angles_rad.size()));
  int frame = 0;
  for (const double angle : angles_rad) small::set(motion, frame++, small::joint_of(character, "arm_left/lift"), angle);
  return motion;
}

std::vector<Finding> collisions(const Character& character, const Motion& motion) {
  StageEvaluator evaluator;
  return evaluator.judge(character, motion, "self_collision");
}

TEST(BetweenFrames, AThinLimbThatPassesThroughAnotherIsFoundInTheLaterFrame) {
  const Character character = with_rod_and_post();
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Finding> findings =
        collisions(character, swept(character, {0.3 * sign, 0.2 * sign, -0.2 * sign}));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].subject, kRodAndPost);
    EXPECT_EQ(findings[0].first_frame, 2);
    EXPECT_EQ(findings[0].last_frame, 2);
    EXPECT_NEAR(findings[0].worst_margin, -0.03, 1e-3);
  }
}

TEST(BetweenFrames, ALimbThatTurnsBackBeforeItIsNotFound) {
  const Character character = with_rod_and_post();
  EXPECT_TRUE(collisions(character, swept(character, {0.3, 0.1, 0.3, 0.1})).empty());
}

TEST(BetweenFrames, AHingeTakesTheShortWay) {  // 330 degrees further, so 30 degrees back
  const Character character = with_rod_and_post();
  EXPECT_TRUE(collisions(character, swept(character, {0.7, 0.2 + 2.0 * kPi})).empty());
  EXPECT_EQ(collisions(character, swept(character, {0.2, 2.0 * kPi - 0.2})).size(), 1U);
}

TEST(BetweenFrames, WhatLeavesIsNoLongerFound) {
  const Character character = with_rod_and_post();
  const std::vector<Finding> findings = collisions(character, swept(character, {0.0, 0.2, 0.3}));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].last_frame, 0);
  EXPECT_NEAR(findings[0].worst_margin, -0.03, 1e-12);
}

TEST(BetweenFrames, WhatIsDeeperByLessThanAMillimetreLeavesTheFramesMargins) {
  const Character character = with_rod_and_post();
  const std::vector<Finding> findings = collisions(character, swept(character, {0.001, -0.001}));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].first_frame, 0);
  EXPECT_NEAR(findings[0].worst_margin, 0.4 * 0.001 - 0.03, 1e-6);
}

// A pose within its limits, and another that no joint's declared speed forbids one frame later.
struct Steps {
  const Character& character;
  Random random;

  Quat ball(const Joint& joint, const Quat& from, double rate_hz) {
    const Quat q = from_rotation_vector(random.direction() * (random.uniform(0, 1) * joint.max_speed / rate_hz)) * from;
    return random.uniform(0, 1) < 0.5 ? q : -q;  // the same rotation
  }
  void draw(Motion& motion) {
    for (const Joint& joint : character.joints()) {
      if (joint.kind == JointKind::root) continue;
      if (joint.kind == JointKind::ball) {
        const Quat q = from_rotation_vector(random.direction() * random.uniform(0, 0.7 * joint.swing_a_rad));
        small::set(motion, 0, joint, q), small::set(motion, 1, joint, ball(joint, q, motion.rate_hz));
      } else {
        const double value = random.uniform(joint.low, joint.high);
        const double step = random.uniform(-1, 1) * joint.max_speed / motion.rate_hz;
        small::set(motion, 0, joint, value), small::set(motion, 1, joint, value + step);
      }
    }
    for (Rigid& root : motion.root) root = random.rigid(1.0);
  }
};

constexpr int kParts = 256;

// The coordinates in between, as in docs/reference/checks.md. This is a separate implementation, because the check's
// own interpolation is under test.
std::vector<double> row_between(const Character& character, const Motion& motion, double time) {
  std::vector<double> row(motion.row(0).begin(), motion.row(0).end());
  for (const Joint& joint : character.joints()) {
    const double* a = motion.row(0).data() + joint.coord;
    const double* b = motion.row(1).data() + joint.coord;
    double* out = row.data() + joint.coord;
    if (joint.kind == JointKind::hinge || joint.kind == JointKind::prismatic) *out = *a + time * (*b - *a);
    if (joint.kind != JointKind::ball) continue;
    const Quat from(a[0], a[1], a[2], a[3]), to(b[0], b[1], b[2], b[3]);
    const Quat q = from * from_rotation_vector(time * to_rotation_vector(glm::conjugate(from) * to));
    out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
  }
  return row;
}

// The least signed distance of each judged pair of bodies in one pose, where it is negative.
void sink(const Character& character, std::span<const double> row, std::vector<double>& least) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, Rigid{}, row, world);
  std::vector<Solid> solids;
  for (const Collider& c : character.colliders())
    solids.push_back(moved(world[static_cast<std::size_t>(c.joint)], solid_of(c)));
  for (std::size_t p = 0; p < least.size(); ++p) {
    const JudgedPair& pair = character.judged_pairs()[p];
    for (int i = pair.first_pair; i < pair.first_pair + pair.pair_count; ++i) {
      const ColliderPair& each = character.judged_colliders()[static_cast<std::size_t>(i)];
      const Solid &a = solids[static_cast<std::size_t>(each.a)], &b = solids[static_cast<std::size_t>(each.b)];
      const Vec3 d = a.center_m - b.center_m;
      if (glm::dot(d, d) > (a.bound_m + b.bound_m) * (a.bound_m + b.bound_m)) continue;
      least[p] = std::min(least[p], signed_distance(a, b, 0.0));
    }
  }
}

std::vector<double> reported(const Character& character, const Motion& motion) {
  const std::size_t joints = character.joints().size();
  std::vector<Rigid> world(2 * joints);
  for (std::size_t f = 0; f < 2; ++f)
    forward_kinematics(character, motion.root[f], motion.row(static_cast<int>(f)),
                       std::span(world).subspan(f * joints, joints));
  const CheckDef& check = small::check_named("self_collision");
  const CheckSettings settings;
  MarginFold fold(check.subject_count(character), settings.merge_gap_frames);
  const Environment level;
  check.measure({character, motion, world, settings, level, nullptr}, fold);
  return fold.smallest();
}

class BetweenFramesOf : public testing::TestWithParam<const char*> {};

// All moments that the check can examine are among the 257, so it cannot report a deeper overlap than the deepest of
// them.
TEST_P(BetweenFramesOf, NothingIsMissedByMoreThanAMillimetreNorMadeUp) {
  const Character character = *build_character({GetParam(), {}, {}}, stock_library());
  Steps steps{character, Random(99)};
  int hidden = 0;  // overlaps that no frame shows
  for (int i = 0; i < 60; ++i) {
    Motion motion = small::at_rest(character, 2, i % 2 == 0 ? 24.0 : 60.0);
    steps.draw(motion);
    const std::vector<double> margins = reported(character, motion);
    std::vector<double> truth(margins.size(), 0.0), frames(margins.size(), 0.0);
    for (int part = 0; part <= kParts; ++part)
      sink(character, row_between(character, motion, static_cast<double>(part) / kParts), truth);
    for (int frame = 0; frame < 2; ++frame) sink(character, motion.row(frame), frames);
    for (std::size_t p = 0; p < truth.size(); ++p) {
      hidden += truth[p] < frames[p] - 1e-3;
      ASSERT_LE(std::min(margins[p], 0.0), truth[p] + 1e-3) << "motion " << i << " pair " << p;
      ASSERT_GE(std::min(margins[p], 0.0), truth[p] - 1e-9) << "motion " << i << " pair " << p;
    }
  }
  EXPECT_GT(hidden, 5);
}

INSTANTIATE_TEST_SUITE_P(Stock, BetweenFramesOf, testing::Values("human", "mech", "quadruped"),
                         [](const testing::TestParamInfo<const char*>& of) { return std::string(of.param); });

}  // namespace

}  // namespace contort
