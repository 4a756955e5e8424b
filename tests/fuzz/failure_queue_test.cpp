// The way of failures from first sight to bucket, without a worker: its answers are made up.
#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz/failure_queue.h"
#include "tests/stage_evaluator.h"
#include "tests/checks/family_text.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

class QueuedFailures : public testing::Test {
 protected:
  QueuedFailures() : corpus_(create(folder_)) {
    config_.seeds = {bent_elbow(170), bent_elbow(175)};  // so that no case must be drawn
    state_.record.name = "seed_1";
  }
  static SettleTask task(std::int64_t index, const Family& failed, int rank = 0) {
    return {{index}, failed, rank, "0123456789abcdef", false, true};
  }
  WantedFailure next_wanted() {
    const std::optional<FailureJob> job = queue_.next(false);
    EXPECT_TRUE(job && std::holds_alternative<WantedFailure>(*job));
    return std::get<WantedFailure>(job.value());
  }
  // The lead as a worker stores and returns it after shrinking.
  SettledLead shrunk() const {
    SettledLead settled{{"seed_1", made_up(170, 60, 1), made_up(160, 30, 1)}, true, {}, {}};
    settled.lead.original.provenance.index = 0;
    return settled;
  }
  void reply(const FailureJob& job, const SettleReport& report) {
    queue_.take(job, {0, WorkerEnd::replied, print_report(report), ""});
  }
  void die(const FailureJob& job) {
    queue_.take(job, {0, WorkerEnd::crashed, "SIGSEGV", print_spec(bent_elbow(90))});
  }
  std::vector<Lead> leads() const {
    std::vector<Issue> damaged;
    return leads_of(corpus_, damaged);
  }
  const Family elbow_ = family_of(made_up(170, 60, 1)), knee_ = family("pop|human|leg_left/knee");
  TempFolder folder_;
  Corpus corpus_;
  RunConfig config_;
  RunState state_;
  FailureQueue queue_{config_, stock_generator(), corpus_, state_};
};

TEST_F(QueuedFailures, OfOneCaseAreSettledOneAtATime) {
  queue_.want(task(0, elbow_)), queue_.want(task(0, knee_, 1)), queue_.want(task(1, knee_));
  const WantedFailure first = next_wanted();
  EXPECT_EQ(first.task, task(0, elbow_));
  EXPECT_EQ(next_wanted().task, task(1, knee_));
  EXPECT_EQ(queue_.next(true), std::nullopt);
  reply(first, {shrunk(), ""});
  EXPECT_EQ(next_wanted().task, task(0, knee_, 1));
}

TEST_F(QueuedFailures, GoIntoBucketsAsTheyCameInTheMessage) {
  queue_.want(task(0, elbow_));
  reply(next_wanted(), {shrunk(), ""});
  const Bucket bucket = only_bucket(corpus_);
  EXPECT_EQ(state_.new_buckets, std::vector<std::string>{folder_name(bucket)});
  EXPECT_EQ(stored(corpus_, bucket, bucket.min), *shrunk().lead.minimal);
  EXPECT_TRUE(state_.wanted.empty() && state_.unconfirmed.empty());
  EXPECT_TRUE(queue_.is_done(true));
}

TEST_F(QueuedFailures, ThatTheMinimalSpecShowsTooAreNotSettled) {
  queue_.want(task(0, elbow_)), queue_.want(task(0, knee_, 1));
  SettledLead settled = shrunk();
  settled.lead.minimal->co_failures = {knee_};
  reply(next_wanted(), {settled, ""});
  EXPECT_TRUE(state_.wanted.empty());
  EXPECT_EQ(queue_.next(true), std::nullopt);
}

TEST_F(QueuedFailures, OfAShardAreLeftToMerge) {
  config_.shard = {0, 2};
  queue_.want(task(0, elbow_)), queue_.want(task(0, knee_, 1));
  SettledLead settled = shrunk();
  settled.lead.minimal->co_failures = {knee_};
  reply(next_wanted(), {settled, ""});
  EXPECT_TRUE(state_.new_buckets.empty());
  EXPECT_EQ(state_.wanted.size(), 1U) << "merge says which of them need no bucket";
}

TEST_F(QueuedFailures, ThatDidNotShowAgainAreNamed) {
  queue_.want(task(0, elbow_));
  SettledLead settled = shrunk();
  settled.lead.minimal.reset(), settled.confirmed = false;
  reply(next_wanted(), {settled, ""});
  EXPECT_EQ(state_.unconfirmed, std::vector<std::string>{lead_path(corpus_, settled.lead)});
}

TEST_F(QueuedFailures, WaitForAnotherRunWhereTimeIsUp) {
  queue_.want(task(0, elbow_));
  queue_.only_keep();
  const WantedFailure job = next_wanted();
  EXPECT_FALSE(job.task.shrinks);
  SettledLead settled = shrunk();
  settled.lead.minimal.reset();
  reply(job, {settled, ""});
  EXPECT_EQ(queue_.waiting(), std::vector<std::string>{lead_path(corpus_, settled.lead)});
}

TEST_F(QueuedFailures, ThatEndTheirWorkerAreShrunkWithAGuardAndTheEndingIsKept) {
  queue_.want(task(0, elbow_)), queue_.want(task(0, knee_, 1));
  die(next_wanted());
  const WantedFailure again = next_wanted();
  EXPECT_TRUE(again.task.guarded);
  EXPECT_EQ(again.task.family, elbow_);
  ASSERT_TRUE(again.ender);
  EXPECT_EQ(again.ender->original.spec, bent_elbow(90)) << "what the worker noted";
  EXPECT_EQ(again.ender->original.provenance.met_shrinking, elbow_);
  EXPECT_EQ(leads(), std::vector<Lead>{*again.ender});
  reply(again, {shrunk(), ""});
  ASSERT_EQ(state_.unconfirmed, std::vector<std::string>{lead_path(corpus_, *again.ender)}) << "not met again";
  EXPECT_TRUE(is_unsteady(leads().at(0)));
}

TEST_F(QueuedFailures, AnEndingThatTheGuardMeetsAgainIsConfirmed) {
  queue_.want(task(0, elbow_));
  die(next_wanted());
  const WantedFailure again = next_wanted();
  SettledLead settled = shrunk();
  Lead met = *again.ender;
  met.minimal = met.original;
  settled.incidental = {met};
  reply(again, {settled, ""});
  EXPECT_TRUE(state_.unconfirmed.empty());
  EXPECT_EQ(state_.new_buckets.size(), 2U);
}

TEST_F(QueuedFailures, ThatEndTheGuardedWorkerTooAreUnconfirmed) {
  queue_.want(task(0, elbow_));
  die(next_wanted());
  die(next_wanted());
  EXPECT_EQ(state_.unconfirmed.size(), 2U) << "the failure, and what ended its worker first";
  for (const Lead& lead : leads()) EXPECT_TRUE(is_unsteady(lead));
  EXPECT_TRUE(queue_.is_done(true) && state_.wanted.empty());
}

TEST_F(QueuedFailures, SayOnceWhatTheCorpusRefuses) {
  queue_.want(task(0, elbow_));
  reply(next_wanted(), {shrunk(), "no room"});
  EXPECT_EQ(queue_.issue().code, "file.unwritable");
  EXPECT_EQ(queue_.issue().text, "no room");
}

// ---- leads of runs whose time was up

class WaitingLeads : public QueuedFailures {
 protected:
  WaitingLeads() {
    lead_ = shrunk().lead;
    lead_.run = "seed_2", lead_.minimal.reset();
    lead_.original.provenance.shrink_stopped = kWaits;
    path_ = keep_lead(corpus_, lead_).value();
    queue_.find_waiting();
  }
  WaitingLead next_waiting() {
    const std::optional<FailureJob> job = queue_.next(true);
    EXPECT_TRUE(job && std::holds_alternative<WaitingLead>(*job));
    return std::get<WaitingLead>(job.value());
  }
  Lead lead_;
  std::string path_;
};

TEST_F(WaitingLeads, ComeAfterWhatTheRunItselfFound) {
  queue_.want(task(0, elbow_));
  EXPECT_EQ(queue_.waiting(), std::vector<std::string>{path_});
  EXPECT_EQ(next_wanted().task, task(0, elbow_));
  EXPECT_EQ(queue_.next(false), std::nullopt) << "there is no time";
  EXPECT_EQ(next_waiting().task, (ShrinkTask{path_, false}));
}

TEST_F(WaitingLeads, AreFiledUnderTheirOwnRun) {
  const WaitingLead job = next_waiting();
  SettledLead settled = shrunk();
  settled.lead.run = "seed_2";
  queue_.take(job, {0, WorkerEnd::replied, print_report(ShrinkReport{settled, ""}), ""});
  EXPECT_EQ(only_bucket(corpus_).runs, std::vector<std::string>{"seed_2"});
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_FALSE(fs::exists(corpus_.folder() + "/leads/seed_2"));
}

TEST_F(WaitingLeads, ThatAnotherProcessHasTakenAreNoMatter) {
  queue_.take(next_waiting(), {0, WorkerEnd::replied, print_report(ShrinkReport{}), ""});
  EXPECT_EQ(queue_.issue().code, "");
  EXPECT_TRUE(state_.unconfirmed.empty() && queue_.is_done(true));
}

TEST_F(WaitingLeads, AreTriedWithAGuardAndThenGivenUp) {
  const WaitingLead first = next_waiting();
  die(first);
  const WaitingLead second = next_waiting();
  EXPECT_EQ(second.task, (ShrinkTask{path_, true}));
  die(second);
  EXPECT_EQ(state_.unconfirmed, std::vector<std::string>{path_});
  EXPECT_TRUE(is_unsteady(leads().at(0)));
  EXPECT_TRUE(queue_.is_done(true));
}

}  // namespace
}  // namespace contort
