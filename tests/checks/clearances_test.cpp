// Compares the distances of judged pairs with those of all pairs of colliders measured separately; and self_collision,
// which skips most pairs, with itself without skipping.
#include "checks/clearances.h"

#include <gtest/gtest.h>

#include "fuzz/draw.h"
#include "generator/generate.h"
#include "model/motion/place_frames.h"
#include "tests/checks/small_character.h"
#include "tests/geometry/solids.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

using test_solids::Random;

double brute_force_m(const Character& character, std::span<const Rigid> world, const JudgedPair& pair) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = pair.first_pair; i < pair.first_pair + pair.pair_count; ++i) {
    const auto solid = [&](int c) {
      const Collider& collider = character.colliders()[static_cast<std::size_t>(c)];
      return moved(world[static_cast<std::size_t>(collider.joint)], solid_of(collider));
    };
    const ColliderPair& each = character.judged_colliders()[static_cast<std::size_t>(i)];
    least = std::min(least,
                     signed_distance(solid(each.a), solid(each.b), std::numeric_limits<double>::infinity()));
  }
  return least;
}

// A walk through poses: slow for some frames, then a jump.
Motion wandering(const Character& character, int frames, Random& random) {
  Motion motion = small::at_rest(character, frames);
  for (const Joint& joint : character.joints()) {
    Quat turn = from_rotation_vector(random.direction() * random.uniform(0, 0.7));
    double value = random.uniform(joint.low, joint.high);
    for (int frame = 0; frame < frames; ++frame) {
      const double step = frame % 16 == 0 ? 0.5 : 0.01;
      turn = from_rotation_vector(random.direction() * step) * turn;
      value += random.uniform(-step, step) * (joint.kind == JointKind::prismatic ? 0.1 : 1.0);
      if (joint.kind == JointKind::ball) small::set(motion, frame, joint, turn);
      if (joint.kind == JointKind::hinge || joint.kind == JointKind::prismatic) small::set(motion, frame, joint, value);
    }
  }
  for (Rigid& root : motion.root) root = random.rigid(1.0);
  return motion;
}

class ClearancesOf : public testing::TestWithParam<const char*> {
 protected:
  Character character_ = *build_character({GetParam(), {}, {}}, stock_library());
};

// Thresholds are random, too: below the threshold the result is the distance, otherwise a value between them.
TEST_P(ClearancesOf, AreExactWhereItMattersAndNeverTooGreat) {
  Random random(7);
  const Motion motion = wandering(character_, 64, random);
  std::vector<Rigid> world;
  place_frames(character_, motion, world);
  Clearances clearances(character_);
  int exact = 0, gaps = 0;
  for (std::size_t frame = 0; frame < 64; ++frame) {
    const auto places = std::span<const Rigid>(world).subspan(frame * character_.joints().size(),
                                                              character_.joints().size());
    clearances.place(places);
    std::vector<DuePair> due;
    for (std::size_t p = 0; p < character_.judged_pairs().size(); ++p) {
      const double truth_m = brute_force_m(character_, places, character_.judged_pairs()[p]);
      const double gap_m = clearances.gap_m(p);
      gaps += gap_m > 0.0;
      ASSERT_FALSE(gap_m > truth_m + 1e-12) << "frame " << frame << " pair " << p;
      const double matters_m = random.uniform(0.0, 0.3);
      if (random.uniform(0, 1) < 0.5) due.push_back({p, matters_m, matters_m + random.uniform(0.0, 0.2)});
    }
    clearances.measure(due);
    for (const DuePair& each : due) {
      const double truth_m = brute_force_m(character_, places, character_.judged_pairs()[each.judged]);
      const double got_m = clearances.distance_m(each);
      if (truth_m < each.matters_m) {
        ++exact;
        ASSERT_NEAR(got_m, truth_m, 1e-12) << "frame " << frame << " pair " << each.judged;
      } else {
        ASSERT_GE(got_m, each.matters_m) << "frame " << frame << " pair " << each.judged;
        ASSERT_LE(got_m, truth_m + 1e-12) << "frame " << frame << " pair " << each.judged;
      }
    }
  }
  EXPECT_GT(exact, 100);
  EXPECT_GT(gaps, 100);
}

MarginFold folded(const Stage& stage, const Motion& motion, bool all) {
  const CheckDef& check = small::check_named("self_collision");
  const CheckSettings settings;
  std::vector<Rigid> world;
  place_frames(*stage.character, motion, world);
  MarginFold fold(check.subject_count(*stage.character), settings.merge_gap_frames, check.resolution);
  if (all) fold.record(motion.frame_count);  // then every margin matters
  check.measure({*stage.character, motion, world, settings, stage.environment, nullptr}, fold);
  return fold;
}

// Skipped pairs change nothing: neither findings nor the smallest distance of any pair. Cases are drawn until there are
// enough collisions to compare, as actions keep bodies apart.
TEST_P(ClearancesOf, WhatSelfCollisionLeavesOutChangesNothing) {
  constexpr int kEnough = 20, kCases = 200, kMostCases = 1000;
  int episodes = 0;
  DrawConfig config{{GetParam()}};
  config.profile.wild_poses = true;
  for (int i = 0; i < kCases || (episodes <= kEnough && i < kMostCases); ++i) {
    const Stage stage = *build_stage(draw_spec(config, stock_generator(), 5, i), stock_library());
    const Motion motion = generate(stage);
    const MarginFold some = folded(stage, motion, false), all = folded(stage, motion, true);
    ASSERT_EQ(some.smallest().size(), all.smallest().size());
    for (std::size_t p = 0; p < all.smallest().size(); ++p)
      if (all.smallest()[p] < 1e9)
        ASSERT_NEAR(some.smallest()[p], all.smallest()[p], 1e-12) << "case " << i << " pair " << p;
      else
        ASSERT_EQ(some.smallest()[p], all.smallest()[p]) << "case " << i << " pair " << p;
    ASSERT_EQ(some.episodes().size(), all.episodes().size()) << "case " << i;
    for (std::size_t e = 0; e < all.episodes().size(); ++e) {
      const MarginFold::Episode got = some.episodes()[e], truth = all.episodes()[e];
      ASSERT_EQ(got.subject, truth.subject);
      ASSERT_EQ(got.first, truth.first);
      ASSERT_EQ(got.worst, truth.worst);
      ASSERT_EQ(got.last, truth.last);
    }
    episodes += static_cast<int>(all.episodes().size());
  }
  EXPECT_GT(episodes, kEnough);
}

INSTANTIATE_TEST_SUITE_P(Stock, ClearancesOf, testing::Values("human", "mech", "quadruped"),
                         [](const testing::TestParamInfo<const char*>& of) { return std::string(of.param); });

}  // namespace

}  // namespace contort
