// A staged search tries actions alone first, then pairs and crowds of clean ones.
#include "fuzz/stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "fuzz/compose.h"
#include "fuzz/islands.h"
#include "tests/corpus/temp_folder.h"
#include "tests/fuzz/small_runs.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

using namespace small_runs;

constexpr std::int64_t kSeed = 3;
constexpr std::int64_t kEpoch = std::int64_t{kEpochRounds} * kRound;

// The indices of an island's cases in an epoch, ascending.
std::vector<std::int64_t> cases_of_epoch(int island, std::int64_t epoch = 0) {
  std::vector<std::int64_t> cases;
  for (std::int64_t index = epoch * kEpoch; index < (epoch + 1) * kEpoch; ++index)
    if (island_of(index) == island) cases.push_back(index);
  return cases;
}

// Runs an epoch with made-up results, and gives the lineages of its cases.
template <class IsClean>
std::vector<Lineage> lineages_of_epoch(IsClean is_clean, std::int64_t epoch = 0) {
  Ingredients known;
  std::vector<Lineage> lineages;
  for (const std::int64_t index : cases_of_epoch(5, epoch)) {
    lineages.push_back(known.lineage_of(kSeed, index));
    known.learn(lineages.back(), is_clean(lineages.back()));
  }
  return lineages;
}

std::vector<ActionUse> uses_in(const Spec& spec) {
  std::vector<ActionUse> all;
  const auto add = [&](const SequenceDesc& sequence) {
    for (const ClipDesc& clip : sequence.clips) all.insert(all.end(), clip.actions.begin(), clip.actions.end());
  };
  for (const SequenceDesc& sequence : spec.sequences) add(sequence);
  for (const InterruptDesc& interrupt : spec.interrupts) add(interrupt.sequence);
  for (ActionUse& use : all) use.start_frame = 0;  // an ingredient begins elsewhere
  return all;
}

TEST(Stages, AllCasesOfAnEpochOnAnIslandShareTheirSetting) {
  for (const std::int64_t epoch : {0, 1, 7})
    for (const std::int64_t index : cases_of_epoch(5, epoch)) {
      EXPECT_EQ(setting_of(index), epoch * kEpoch + 5 * kGeneration);
      const RawSpec raw = staged_raw(kSeed, {index}, Profile{}), setting = draw_raw(kSeed, setting_of(index));
      EXPECT_EQ(raw.character, setting.character);
      EXPECT_EQ(raw.parts, setting.parts);
      EXPECT_EQ(raw.objects, setting.objects);
      EXPECT_EQ(raw.ground, setting.ground);
      EXPECT_EQ(raw.dynamics, setting.dynamics);
    }
}

TEST(Stages, ACleanEpochHasSinglesPairsAndCrowds) {
  std::map<CaseStage, int> cases;
  for (const Lineage& lineage : lineages_of_epoch([](const Lineage&) { return true; })) ++cases[stage_of(lineage)];
  EXPECT_EQ(cases[CaseStage::single], 12);
  EXPECT_EQ(cases[CaseStage::pair], 12);
  EXPECT_EQ(cases[CaseStage::crowd], 8);
}

TEST(Stages, NothingIsCombinedOfSinglesThatAreNotClean) {
  const auto odd_is_clean = [](const Lineage& lineage) { return lineage.size() > 1 || lineage.front() % 2 == 1; };
  int combined = 0;
  for (const Lineage& lineage : lineages_of_epoch(odd_is_clean)) {
    combined += lineage.size() > 1;
    for (std::size_t i = 0; i + 1 < lineage.size(); ++i) EXPECT_EQ(lineage[i] % 2, 1) << lineage[i];
  }
  EXPECT_GT(combined, 10);
  for (const Lineage& lineage : lineages_of_epoch([](const Lineage&) { return false; })) EXPECT_EQ(lineage.size(), 1U);
}

TEST(Stages, ACrowdHoldsNoPairThatFailed) {
  std::set<Ingredients::Pair> failed;
  int crowds = 0;
  const auto no_pair_is_clean = [&](const Lineage& lineage) {
    if (stage_of(lineage) == CaseStage::pair) failed.insert({lineage[0], lineage[1]});
    for (std::size_t i = 0; stage_of(lineage) == CaseStage::crowd && i + 1 < lineage.size(); ++i)
      for (std::size_t j = i + 1; j + 1 < lineage.size(); ++j)
        EXPECT_FALSE(failed.contains({lineage[i], lineage[j]})) << lineage[i] << " and " << lineage[j];
    crowds += stage_of(lineage) == CaseStage::crowd;
    return stage_of(lineage) != CaseStage::pair;
  };
  lineages_of_epoch(no_pair_is_clean);
  EXPECT_GT(failed.size(), 5U);
  EXPECT_GT(crowds, 0);
}

TEST(Stages, AnEpochKnowsNothingOfTheOneBefore) {
  Ingredients known;
  for (const std::int64_t index : cases_of_epoch(5)) known.learn({index}, true);
  const std::int64_t next = cases_of_epoch(5, 1)[2 * kGeneration];  // the first pair of the next epoch
  EXPECT_EQ(planned_stage(next), CaseStage::pair);
  EXPECT_EQ(known.lineage_of(kSeed, next), Lineage{next});
  known.learn({next}, true);
  EXPECT_EQ(known.clean, std::vector<std::int64_t>{next});
}

// So neither of the two actions alone shows the failures of the pair.
TEST(Stages, APairDoesWhatItsSinglesDo) {
  const DrawConfig config{{"human", "mech", "quadruped"}};
  const auto actions = [&](const Lineage& lineage) {
    return uses_in(compose(raw_of(config, stock_generator(), kSeed, lineage), config, stock_generator()));
  };
  for (int island = 0; island < 24; ++island) {
    const std::vector<std::int64_t> cases = cases_of_epoch(island);
    const std::vector<ActionUse> one = actions({cases[0]}), other = actions({cases[5]});
    const std::vector<ActionUse> pair = actions({cases[0], cases[5], cases[9]});
    ASSERT_EQ(one.size(), 1U);
    ASSERT_EQ(pair.size(), 2U);
    EXPECT_EQ(pair[0], one[0]);
    EXPECT_EQ(pair[1], other[0]);
  }
}

// If a profile has no interrupts, all actions of a crowd are still played.
TEST(Stages, WithoutInterruptsAllActionsAreInTheQueue) {
  DrawConfig config{{"human"}};
  config.profile.interrupts = 0.0;
  for (std::int64_t last = 100; last < 140; ++last) {
    const Lineage crowd = {0, 1, 2, 3, 256, 257, last};
    const Spec spec = compose(raw_of(config, stock_generator(), kSeed, crowd), config, stock_generator());
    EXPECT_EQ(uses_in(spec).size(), crowd.size() - 1);
    EXPECT_TRUE(spec.interrupts.empty());
  }
}

class StagedRuns : public testing::Test {
 protected:
  RunConfig staged(std::int64_t cases, int jobs) const {
    RunConfig config = config_of(cases, jobs);
    config.draw.profile.staged = true;
    return config;
  }
  TempFolder folder_;
};

TEST_F(StagedRuns, AreTheSameForAnyNumberOfWorkersAndCountTheirStages) {
  const Corpus one = create(folder_ / "one"), three = create(folder_ / "three");
  const RunResult result = run(staged(1100, 1), one);
  run(staged(1100, 3), three);
  EXPECT_EQ(first_difference(tree_of(one.folder()), tree_of(three.folder())), "");
  EXPECT_GT(result.record.arms.at("single").cases, 0);
  EXPECT_GT(result.record.arms.at("pair").cases, 0);
  EXPECT_GT(result.record.arms.at("crowd").cases, 0);
}

TEST_F(StagedRuns, ThatAreStoppedAndResumedLeaveTheSameBytes) {
  expect_resuming_changes_nothing(folder_, staged(1100, 2), 2);
}

TEST_F(StagedRuns, OfThreeShardsMergeToOneRun) { expect_shards_make_one_run(folder_, staged(1100, 2), 3); }

}  // namespace

}  // namespace contort
