// The counts of a run, and the failures that it wants.
#include "fuzz/run_statistics.h"

#include <gtest/gtest.h>

#include "tests/checks/family_text.h"

namespace contort {
namespace {

class CountedCases : public testing::Test {
 protected:
  std::vector<SettleTask> add(std::int64_t index, std::vector<Family> broken) {
    RoundCase one{{index}};
    one.report = EvaluateReport{true, 60, "0123456789abcdef", {"ground steps"}, {}, {}, std::move(broken), {}, {}};
    one.ends_process = ends_process_;
    return statistics_.add(one);
  }
  RunConfig config_;
  RunState state_;
  RunStatistics statistics_{config_, state_};
  bool ends_process_ = false;
  const Family knee_ = family("pop|human|leg_left/knee"), hip_ = family("pop|human|leg_left/hip");
};

TEST_F(CountedCases, AddUp) {
  config_.seeds.resize(1);
  add(0, {knee_}), add(1, {});
  const RunRecord& record = state_.record;
  EXPECT_EQ(record.cases, 2);
  EXPECT_EQ(record.failing, 1);
  EXPECT_EQ(record.frames, 120);
  EXPECT_EQ(record.discarded, 0);
  EXPECT_EQ(record.tested.at("ground steps"), 2);
  EXPECT_EQ(record.arms.at("seed"), (StrategyCount{1, 1}));
  EXPECT_EQ(record.arms.at(statistics_.strategy_of_case({1})), (StrategyCount{1, 0}));
  EXPECT_EQ(record.families.at(knee_), (FamilyCount{1, 0, {0}, "seed", 1}));
}

// Four cases of island 0 and one of island 1, then one of island 0 in the next round of its epoch and one in the next
// epoch.
TEST_F(CountedCases, OfOneSettingAreOneGroup) {
  for (const std::int64_t index : {0, 1, 2, 3}) add(index, {knee_});
  add(kGeneration, {hip_}), add(kRound, {hip_, knee_}), add(kRound * kEpochRounds, {knee_});
  EXPECT_EQ(state_.record.groups, 3);
  EXPECT_EQ(state_.record.families.at(knee_).groups, 2);
  EXPECT_EQ(state_.record.families.at(hip_).groups, 2);
}

TEST_F(CountedCases, WantTheFirstOfEachFamily) {
  config_.shrinks_per_family = 2;
  const std::vector<SettleTask> wanted = {{{4}, knee_, 0, "0123456789abcdef", false, true}};
  EXPECT_EQ(add(4, {knee_}), wanted);
  EXPECT_EQ(add(5, {knee_}).size(), 1U);
  EXPECT_TRUE(add(6, {knee_}).empty());
  EXPECT_EQ(state_.record.families.at(knee_).cases, 3);
  EXPECT_EQ(state_.record.families.at(knee_).first_indices, (std::vector<std::int64_t>{4, 5}));
}

TEST_F(CountedCases, WantTheEarliestOfEachCase) {
  config_.shrinks_per_case = 1;
  const std::vector<SettleTask> wanted = add(4, {knee_, hip_});
  ASSERT_EQ(wanted.size(), 1U);
  EXPECT_EQ(wanted[0].family, knee_);
  EXPECT_TRUE(state_.record.families.at(hip_).first_indices.empty());
}

TEST_F(CountedCases, ThatEndTheirProcessAreShrunkWithAGuard) {
  ends_process_ = true;
  EXPECT_TRUE(add(4, {family("crash|human|SIGSEGV")}).at(0).guarded);
}

TEST_F(CountedCases, AgainstABaseCountOnlyWhatChanged) {
  state_.record.against.emplace();
  const auto add_compared = [&](std::int64_t index, const Comparison& comparison) {
    RoundCase one{{index}};
    one.report = EvaluateReport{true, 60, "0123456789abcdef", {}, {}, {}, {hip_, knee_}, {}, {}, comparison};
    return statistics_.add(one);
  };
  const std::vector<SettleTask> wanted = {{{1}, knee_, 0, "0123456789abcdef", false, true, "bb"}};
  EXPECT_EQ(add_compared(1, {"", true, 3, "bb", {knee_}, {}, {}}), wanted);
  EXPECT_EQ(add_compared(2, {"", true, 3, "bb", {}, {hip_}, {knee_}}).size(), 1U);
  EXPECT_TRUE(add_compared(3, {"", true, 7, "bb", {}, {}, {}}).empty());
  EXPECT_TRUE(add_compared(4, {"", true, 2, "bb", {}, {}, {}}).empty());
  EXPECT_TRUE(add_compared(5, {}).empty());
  EXPECT_TRUE(add_compared(6, {"base.crash: gone", false, -1, "", {}, {}, {}}).empty());
  const AgainstCounts expected{"", "", 1, 2, 1, 1, 1, 1, 3, 7, 6, "base.crash: gone"};
  EXPECT_EQ(state_.record.against, expected);
  EXPECT_EQ(state_.record.failing, 2);
  EXPECT_EQ(state_.record.families.size(), 2U);
}

TEST_F(CountedCases, AgainstABaseTeachTheirIslandAllThatFailed) {
  config_.draw.profile.staged = false;
  std::int64_t index = 0;
  while (group_of(index) != group_of_target(knee_)) ++index;
  RoundCase one{{index}};
  one.report = EvaluateReport{};
  one.report->broken = {knee_}, one.report->against = Comparison{};
  EXPECT_TRUE(statistics_.add(one).empty());
  EXPECT_EQ(state_.islands[static_cast<std::size_t>(island_of(index))].retired, std::vector<Family>{knee_});
}

// A staged run combines singles that are clean and whose requests were met.
TEST_F(CountedCases, OfSinglesOnlyThoseThatAreCleanAndMetAreIngredients) {
  const auto add_single = [&](std::int64_t index, bool built, bool unmet, std::vector<Family> broken) {
    RoundCase one{{index}};
    one.report = EvaluateReport{built, 60, "0123456789abcdef", {}, {}, {}, std::move(broken), {}, {}};
    if (unmet) one.report->unmet = {"reach on arm_left: out_of_reach"};
    statistics_.add(one);
  };
  add_single(8, true, false, {}), add_single(9, true, true, {});
  add_single(10, true, false, {knee_}), add_single(11, false, false, {});
  EXPECT_EQ(state_.ingredients[static_cast<std::size_t>(island_of(8))].clean, std::vector<std::int64_t>{8});
}

TEST_F(CountedCases, CountRequestsThatWereNotMetAndChecksThatCouldNotJudge) {
  RoundCase one{{8}};
  one.report.emplace().built = true;
  one.report->unmet = {"reach on arm_left: out_of_reach"};
  one.report->not_judged = {"balance: the motion has no dynamics"};
  statistics_.add(one);
  one.lineage = {9}, one.report->unmet.clear();
  statistics_.add(one);
  EXPECT_EQ(state_.record.unmet, (std::map<std::string, std::int64_t>{{"reach on arm_left: out_of_reach", 1}}));
  EXPECT_EQ(state_.record.not_judged, (std::map<std::string, std::int64_t>{{"balance: the motion has no dynamics", 2}}));
  const RunRecord both = added_up({state_.record, state_.record});
  EXPECT_EQ(both.unmet.at("reach on arm_left: out_of_reach"), 2);
  EXPECT_EQ(both.not_judged.at("balance: the motion has no dynamics"), 4);
}

TEST_F(CountedCases, TeachTheirIsland) {
  config_.draw.profile.staged = false;
  RoundCase one{{8}};
  one.report = EvaluateReport{};
  one.report->near = {{knee_, 0.5}};
  statistics_.add(one);
  EXPECT_TRUE(state_.islands[static_cast<std::size_t>(island_of(8))].pools.contains(knee_));
}

}  // namespace
}  // namespace contort
