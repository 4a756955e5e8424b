// A round gives out its cases in order, and is complete when all have results.
#include "fuzz/round.h"

#include <gtest/gtest.h>

#include "tests/corpus/sample_corpus.h"

namespace contort {
namespace {

Round round_of(int cases) {
  Round round;
  for (int index = 0; index < cases; ++index) round.add({index});
  return round;
}

Case crash() {
  Case ended = made_up(170, 60, 1);
  ended.expect.check = "crash", ended.expect.subject = "SIGSEGV";
  return ended;
}

TEST(Rounds, HandOutEachCaseOnce) {
  Round round = round_of(3);
  EXPECT_EQ(round.next(), 0);
  EXPECT_EQ(round.next(), 1);
  round.take_report(1, {});
  EXPECT_EQ(round.next(), 2);
  EXPECT_EQ(round.next(), std::nullopt);
  EXPECT_EQ(round.done_count(), 1);
  EXPECT_FALSE(round.is_whole());
  round.take_report(2, {}), round.take_report(0, {});
  EXPECT_TRUE(round.is_whole());
  EXPECT_FALSE(round.has_failure());
}

TEST(Rounds, KnowWhetherAnythingFailed) {
  Round round = round_of(1);
  EvaluateReport report;
  report.broken = {family_of(made_up(170, 60, 1))};
  round.take_report(0, report);
  EXPECT_TRUE(round.has_failure());
}

TEST(Rounds, TryAgainBeforeAllElseWhatEndedItsProcess) {
  Round round = round_of(3);
  round.next();
  round.take_ending(0, crash(), false);
  EXPECT_EQ(round.done_count(), 0);
  EXPECT_EQ(round.next(), 0);
  round.take_ending(0, crash(), false);
  const RoundCase& twice = round.cases()[0];
  EXPECT_TRUE(twice.ends_process && twice.report->built);
  EXPECT_FALSE(twice.ended_once);
  EXPECT_EQ(twice.report->broken, std::vector<Family>{family_of(crash())});
  EXPECT_EQ(round.next(), 1);
  EXPECT_EQ(round.done_count(), 1);
}

TEST(Rounds, RememberWhatEndedAProcessOnce) {
  Round round = round_of(1);
  round.next();
  round.take_ending(0, crash(), false);
  EXPECT_EQ(round.next(), 0);
  round.take_report(0, {});
  EXPECT_EQ(round.cases()[0].ended_once, crash());
  EXPECT_FALSE(round.cases()[0].ends_process);
}

TEST(Rounds, AskTheBaseAboutWhatEndsThisBuild) {
  Round round(true);
  round.add({4});
  round.next();
  round.take_ending(0, crash(), false);
  EXPECT_TRUE(round.task(0).ends.empty()) << "it is tried again first";
  round.next();
  round.take_ending(0, crash(), false);
  EXPECT_FALSE(round.is_whole());
  EXPECT_EQ(round.next(), 0);
  EXPECT_EQ(round.task(0), (EvaluateTask{{4}, family_of(crash())}));
  EvaluateReport report;
  report.broken = {family_of(crash())};
  round.take_report(0, report);
  EXPECT_TRUE(round.is_whole());
  EXPECT_TRUE(round.cases()[0].ends_process);
  EXPECT_FALSE(round.cases()[0].ended_once);
}

TEST(Rounds, CountAWorkerThatEndsWhileItAsksTheBaseAsRefused) {
  Round round(true);
  round.add({4});
  round.next();
  round.take_ending(0, crash(), true);
  EXPECT_EQ(round.next(), 0);
  Case other = crash();
  other.expect.subject = "SIGKILL";
  round.take_ending(0, other, false);
  ASSERT_TRUE(round.is_whole());
  const EvaluateReport& report = *round.cases()[0].report;
  EXPECT_EQ(report.broken, std::vector<Family>{family_of(crash())});
  EXPECT_FALSE(report.against->refusal.empty());
  EXPECT_TRUE(counted_families(report).empty());
}

TEST(Rounds, NeedNoSecondWitnessOfAKnownEnding) {
  Round round = round_of(1);
  round.next();
  round.take_ending(0, crash(), true);
  EXPECT_TRUE(round.is_whole());
  EXPECT_TRUE(round.cases()[0].ends_process);
}

}  // namespace
}  // namespace contort
