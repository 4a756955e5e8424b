// Tasks, workers, and endings of tasks.
#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "model/core/hash.h"
#include "process/broker.h"
#include "server/work.h"
#include "tests/scenes.h"
#include "tests/stage_evaluator.h"

namespace contort::server {
namespace {

Task task_of(TaskKind kind) {
  Task task;
  task.kind = kind;
  task.spec.character.name = "mech";
  task.spec.dynamics.mode = Mode::dynamic;
  task.take_frames = 120, task.check = "balance", task.subject = "a \"b\"";
  return task;
}

TEST(Work, TasksAndRepliesReadBack) {
  const Task task = task_of(TaskKind::judge);
  const Result<Task> again = parse_task(print_task(task));
  ASSERT_TRUE(again) << to_line(again.issue());
  EXPECT_EQ(*again, task);
  const Reply reply{"{\"a\":1}", std::string("\0\n5\nx", 6)};
  EXPECT_EQ(*parse_reply(print_reply(reply)), reply);
  const Issue issue{"spec.bad", "/a/0", "a \"b\"\n"};
  EXPECT_EQ(parse_reply(print_reply(issue)).issue(), issue);
  for (const char* damaged : {"", "x", "99\n{}", "issue\n{"}) EXPECT_FALSE(parse_reply(damaged)) << damaged;
}

TEST(Work, EvaluatesAsTheOnePathDoes) {
  Worker worker(stock_generator(), {}, "test");
  StageEvaluator evaluator;
  for (Spec spec : {task_of(TaskKind::evaluate).spec, Spec{}}) {
    if (spec.character.name.empty()) spec.character.name = "human";
    const Evaluation expected = evaluator.run(*build_stage(spec, stock_library()));
    const Result<Reply> reply = worker.run({TaskKind::evaluate, spec, 0, 0, "", "", ""});
    ASSERT_TRUE(reply) << to_line(reply.issue());
    EXPECT_NE(reply->head.find(to_hex(expected.motion_hash)), std::string::npos) << reply->head;
  }
}

TEST(Work, ATakeHoldsStillUntilItsEnd) {
  Worker worker(stock_generator(), {}, "test");
  Task task = task_of(TaskKind::play);
  task.take_frames = 200, task.most_frames = 400;
  const Result<Reply> reply = worker.run(task);
  ASSERT_TRUE(reply) << to_line(reply.issue());
  EXPECT_NE(reply->head.find("\"frame_count\":200"), std::string::npos) << reply->head;
  task.spec.hold_frames = 199;
  const Motion motion = generate(*build_stage(task.spec, stock_library()));
  EXPECT_NE(reply->head.find(to_hex(motion_hash(motion))), std::string::npos) << "and is the motion of that spec";
}

TEST(Work, ATakeIsNoLongerThanItsSequencesNeed) {
  Worker worker(stock_generator(), {}, "test");
  Task task = task_of(TaskKind::play);
  task.take_frames = 200;
  ActionUse crouch;
  crouch.action = "crouch", crouch.slot = "waist", crouch.duration_frames = 20;
  for (const int frame : {30, 150}) {
    InterruptDesc interrupt;
    interrupt.when.frame = frame, interrupt.enter = Enter::end;
    interrupt.sequence.clips.push_back({"", 0, 0, 1.0, {crouch}});
    task.spec.interrupts.push_back(interrupt);
  }
  const Result<Reply> reply = worker.run(task);
  ASSERT_TRUE(reply) << to_line(reply.issue());
  EXPECT_NE(reply->head.find("\"last_frame\":170"), std::string::npos) << "the second one plays\n" << reply->head;
  EXPECT_NE(reply->head.find("\"hold_frames\":100"), std::string::npos) << "as long as between the two\n" << reply->head;
}

TEST(Work, RefusesWhatIsTooLong) {
  Worker worker(stock_generator(), {}, "test");
  Task task = task_of(TaskKind::evaluate);
  task.most_frames = 100, task.spec.hold_frames = 100;
  EXPECT_EQ(worker.run(task).issue().code, "take.too_long");
  task.kind = TaskKind::play, task.take_frames = 101;
  EXPECT_EQ(worker.run(task).issue().code, "take.too_long");
}

std::string misbehave(const std::string& task, WorkerSlot&) {
  if (task == "crash") std::raise(SIGSEGV);
  if (task == "hang") for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  return "did " + task;
}

// Time enough for a sanitizer to print where a crash was, on a machine that has much else to do.
TEST(Broker, ATaskThatCrashesItsWorkerCostsNothingElse) {
  BrokerLimits limits;
  limits.each.seconds = 60.0;
  Broker broker(limits, misbehave);
  EXPECT_EQ(*broker.run("this", Urgency::now).text, "did this");
  EXPECT_EQ(broker.run("crash", Urgency::now).text.issue().code, "work.crash");
  EXPECT_EQ(*broker.run("that", Urgency::later).text, "did that");
  EXPECT_EQ(broker.load().ended_badly, 1);
}

TEST(Broker, ATaskThatHangsCostsItsTimeAndNothingElse) {
  BrokerLimits limits;
  limits.each.seconds = 2.0;
  Broker broker(limits, misbehave);
  EXPECT_EQ(broker.run("hang", Urgency::now).text.issue().code, "work.timeout");
  EXPECT_EQ(*broker.run("that", Urgency::later).text, "did that");
  EXPECT_EQ(broker.load().ended_badly, 1);
}

TEST(Broker, ManyThreadsGetTheirOwnReplies) {
  Broker broker({}, misbehave);
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 200; ++i) {
        const std::string task = std::to_string(t) + "/" + std::to_string(i) + std::string(static_cast<std::size_t>(i * 50), 'x');
        const Result<std::string> reply = broker.run(task, i % 2 == 0 ? Urgency::now : Urgency::later).text;
        if (reply && *reply == "did " + task) ++right;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 1600);
}

TEST(Broker, SaysSoWhenTooMuchWaits) {
  BrokerLimits limits;
  limits.workers = 1, limits.most_waiting = 1, limits.each.seconds = 3.0;
  Broker broker(limits, misbehave);
  std::vector<std::thread> threads;
  std::atomic<int> busy = 0;
  for (int t = 0; t < 6; ++t)
    threads.emplace_back([&] {
      const Result<std::string> reply = broker.run("hang", Urgency::now).text;
      if (reply.issue().code == "work.busy") ++busy;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(busy, 4) << "one runs, one waits";
}

}  // namespace
}  // namespace contort::server
