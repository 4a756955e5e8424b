// The crew remembers the task of each worker.
#include "fuzz/crew.h"

#include <gtest/gtest.h>
#include <signal.h>

namespace contort {
namespace {

// Returns the case's number without evaluating it; processing a failure ends the worker.
std::string answer(const std::string& text, WorkerSlot&) {
  const Task task = parse_task(text);
  if (!std::holds_alternative<EvaluateTask>(task)) ::raise(SIGKILL);
  EvaluateReport report;
  report.frames = static_cast<int>(std::get<EvaluateTask>(task).lineage.back());
  return print_report(report);
}

Crew::Finished finished(Crew& crew) {
  for (int tries = 0; tries < 100; ++tries)
    if (std::optional<Crew::Finished> one = crew.wait(1000)) return std::move(*one);
  ADD_FAILURE() << "nobody answers";
  return {};
}

TEST(Crews, HandBackTheJobWithItsAnswer) {
  Crew crew(1, {}, answer);
  EXPECT_TRUE(crew.has_idle());
  EXPECT_FALSE(crew.is_any_case_running());
  crew.give(PlacedCase{5, {{42}}});
  EXPECT_FALSE(crew.has_idle());
  EXPECT_EQ(crew.busy(), 1);
  EXPECT_TRUE(crew.is_any_case_running());
  const Crew::Finished done = finished(crew);
  EXPECT_EQ(std::get<PlacedCase>(done.job).place, 5);
  EXPECT_EQ(parse_report<EvaluateReport>(done.event.text).frames, 42);
  EXPECT_TRUE(crew.has_idle());
  EXPECT_FALSE(crew.is_any_case_running());
}

TEST(Crews, HandBackTheJobThatEndedItsWorker) {
  Crew crew(1, {}, answer);
  crew.give(FailureJob(WaitingLead{{"a lead", false}, "seed_1", 3}));
  EXPECT_FALSE(crew.is_any_case_running()) << "it is a failure";
  const Crew::Finished done = finished(crew);
  EXPECT_EQ(std::get<WaitingLead>(std::get<FailureJob>(done.job)).task.lead, "a lead");
  EXPECT_EQ(done.event.end, WorkerEnd::crashed);
  crew.give(PlacedCase{0, {{7}}});
  EXPECT_EQ(parse_report<EvaluateReport>(finished(crew).event.text).frames, 7) << "another worker took its place";
}

}  // namespace
}  // namespace contort
