// A run draws some cases evenly, some overlaid with others, and mutates earlier ones. These tests count each kind.
#include "fuzz/lineage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <variant>

#include "fuzz/compose.h"
#include "fuzz/mutate.h"
#include "generator/stage.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

template <class T>
bool begins_with(const std::vector<T>& list, const std::vector<T>& beginning) {
  return list.size() >= beginning.size() && std::equal(beginning.begin(), beginning.end(), list.begin());
}

std::size_t action_count(const Spec& spec) {
  std::size_t count = 0;
  for (const SequenceDesc& sequence : spec.sequences)
    for (const ClipDesc& clip : sequence.clips) count += clip.actions.size();
  return count;
}

DrawConfig all_at_once(std::vector<std::string> characters) {
  DrawConfig config{std::move(characters)};
  config.profile.staged = false;
  return config;
}

TEST(Lineage, ArmsHaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (int arm = 0; arm < kStrategies; ++arm) names.insert(strategy_name(static_cast<Strategy>(arm)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kStrategies));
}

// The baseline against which the search is measured.
TEST(Lineage, EvenCasesAreDrawsAsTheyAre) {
  DrawConfig config{{"human"}};
  config.profile.staged = false;
  config.profile.guided = 0.0, config.profile.uniform = 1.0;
  for (std::int64_t index = 0; index < 50; ++index)
    EXPECT_EQ(raw_of(config, stock_generator(), 3, {index}), draw_raw(3, index));
}

TEST(Lineage, EveryArmHasItsShare) {
  std::map<Strategy, double> percent;
  constexpr int kCases = 20000;
  for (std::int64_t index = 0; index < kCases; ++index) percent[unguided(odds_of(1, {}), index)] += 100.0 / kCases;
  const std::map<Strategy, double> expected = {{Strategy::uniform, 2.0},
                                          {Strategy::corners, 68.6},
                                          {Strategy::overlaid, 19.6},
                                          {Strategy::swarm, 4.9},
                                          {Strategy::corners_and_swarm, 4.9}};
  for (const auto& [arm, share] : expected) EXPECT_NEAR(percent[arm], share, 1.0) << strategy_name(arm);
  EXPECT_EQ(percent.size(), expected.size());
}

// An eighth of all numbers is at each end of the range, plus the few that are drawn there by chance.
TEST(Corners, AreInSequencesAndInterruptsAndOnTheGround) {
  std::map<std::string, std::array<int, 3>> seen;  // number of values at 0, at the upper end, and in all
  const auto look = [&](const std::string& name, std::span<const int> numbers) {
    for (const int number : numbers) ++seen[name][2], seen[name][0] += number == 0, seen[name][1] += number == kLattice;
  };
  const auto look_at_clips = [&](const std::string& name, const std::vector<RawClip>& clips) {
    for (const RawClip& clip : clips) {
      look(name + " times", std::array{clip.start, clip.stretch});
      for (const RawAction& action : clip.actions) {
        look(name + " values", action.values);
        look(name + " action times", std::array{action.start, action.duration, action.blend_in, action.blend_out});
      }
    }
  };
  for (std::int64_t index = 0; index < 400; ++index) {
    RawSpec raw = draw_raw(1, index);
    Dice dice(1, index, 0);
    go_to_corners(raw, dice);
    look("ground", raw.ground);
    for (const std::vector<RawClip>& clips : raw.sequences) look_at_clips("sequence", clips);
    for (const RawInterrupt& interrupt : raw.interrupts) look_at_clips("interrupt", interrupt.clips);
  }
  EXPECT_EQ(seen.size(), 7U);
  for (const auto& [name, count] : seen)
    for (const int at_end : {count[0], count[1]}) EXPECT_NEAR(at_end, count[2] / 8.0, count[2] / 32.0) << name;
}

TEST(Lineage, StreamsOfOneCaseDiffer) {
  EXPECT_NE(draw_raw(3, 5), draw_raw(3, 5, 1));
  EXPECT_NE(draw_raw(3, 5, 1), draw_raw(3, 5, 2));
  EXPECT_EQ(draw_raw(3, 5, 1), draw_raw(3, 5, 1));
}

TEST(Crowding, KeepsWhatIsThereAndAddsBehindIt) {
  for (std::int64_t index = 0; index < 200; ++index) {
    const RawSpec before = draw_raw(1, index), mate = draw_raw(1, index, 1);
    RawSpec after = before;
    overlay(after, mate);
    ASSERT_GE(after.sequences.size(), std::max(before.sequences.size(), mate.sequences.size()));
    for (std::size_t s = 0; s < before.sequences.size(); ++s)
      for (std::size_t c = 0; c < before.sequences[s].size(); ++c)
        EXPECT_TRUE(begins_with(after.sequences[s][c].actions, before.sequences[s][c].actions));
    EXPECT_TRUE(begins_with(after.interrupts, before.interrupts));
    EXPECT_EQ(after.interrupted, std::min(before.interrupted, mate.interrupted));
    for (const std::size_t count : {kLoadCount, kBlowCount})
      EXPECT_EQ(after.dynamics[count], std::max(before.dynamics[count], mate.dynamics[count]));
    after.sequences = before.sequences, after.interrupts = before.interrupts, after.interrupted = before.interrupted;
    for (const std::size_t count : {kLoadCount, kBlowCount}) after.dynamics[count] = before.dynamics[count];
    EXPECT_EQ(after, before);
  }
}

TEST(Crowding, EndsWhereThereIsNoRoom) {
  RawSpec raw = draw_raw(1, 0);
  for (std::uint64_t mate = 1; mate <= 100; ++mate) overlay(raw, draw_raw(1, 0, mate));
  EXPECT_LE(raw.sequences.size(), kMostSequences);
  EXPECT_EQ(raw.interrupts.size(), kMostInterrupts);
  for (const std::vector<RawClip>& clips : raw.sequences) {
    EXPECT_LE(clips.size(), kMostClips);
    for (const RawClip& clip : clips) EXPECT_LE(clip.actions.size(), kMostActions);
  }
}

TEST(Crowding, MakesCasesThatBuildAndHaveTwiceTheActions) {
  const DrawConfig config = all_at_once({"human", "mech", "quadruped"});
  std::size_t even = 0, crowded = 0;
  for (std::int64_t index = 0; index < 300; ++index) {
    if (unguided(odds_of(1, config.profile), index) != Strategy::overlaid) continue;
    const Spec spec = compose(raw_of(config, stock_generator(), 1, {index}), config, stock_generator());
    const Result<Stage> stage = build_stage(spec, stock_library());
    ASSERT_TRUE(stage) << to_line(stage.issue());
    even += action_count(draw_spec(config, stock_generator(), 1, index));
    crowded += action_count(spec);
  }
  EXPECT_GT(even, 0U);
  EXPECT_GT(crowded, 2 * even) << crowded << " beside " << even;
}

// Half of all draws have a level plane, and a crowd only if three of them have; where the profile has no other, all.
TEST(Crowding, BringsGroundsThatAreNotLevel) {
  const auto level_percent = [](const DrawConfig& config) {
    double level = 0.0, all = 0.0;
    for (std::int64_t index = 0; index < 4000; ++index) {
      if (unguided(odds_of(1, config.profile), index) != Strategy::overlaid) continue;
      const Spec spec = compose(raw_of(config, stock_generator(), 1, {index}), config, stock_generator());
      ++all, level += std::holds_alternative<PlaneGround>(spec.environment.ground);
    }
    return 100.0 * level / all;
  };
  DrawConfig config = all_at_once({"human"});
  EXPECT_NEAR(level_percent(config), 12.5, 3.0);
  config.profile.grounds = {"plane", "steps"};  // five of six draws are level
  EXPECT_NEAR(level_percent(config), 100.0 * 125.0 / 216.0, 4.5);
  config.profile.grounds = {"plane"};
  EXPECT_EQ(level_percent(config), 100.0);
}

}  // namespace

}  // namespace contort
