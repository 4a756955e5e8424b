// Workers that end in all ways: the pool reports the ending and continues.
#include "process/worker_pool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <stdexcept>
#include <thread>

namespace contort {
namespace {

// The work of the tests' workers, by task.
std::string obey(const std::string& task, WorkerSlot& slot) {
  slot.note("doing " + task);
  if (task == "crash") ::raise(SIGSEGV);
  if (task == "abort") ::abort();
  if (task == "throw") throw std::runtime_error("as told");
  if (task == "exit") ::_exit(3);
  if (task == "hang")
    for (;;) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (task == "slow but alive")
    for (int i = 0; i < 200; ++i) {
      slot.beat();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  if (task == "eat") {
    std::string all;
    for (;;) all.append(std::size_t{8} << 20, 'x');
  }
  if (task == "long") return std::string(3'000'000, 'a');
  return "did " + task;
}

const WorkerLimits kTight{3.0, std::int64_t{400} << 20};

WorkerEvent next_event(WorkerPool& pool) {
  for (int i = 0; i < 2400; ++i)
    if (std::optional<WorkerEvent> event = pool.wait(50)) return *event;
  ADD_FAILURE() << "nothing happened for two minutes";
  return {};
}

// Time enough to eat, or for a sanitizer to print where a crash was, on a machine that has much else to do.
const WorkerLimits kPatient{30.0, kTight.bytes};

WorkerEvent outcome_of(const std::string& task, const WorkerLimits& limits = kPatient) {
  WorkerPool pool(1, limits, obey);
  pool.give(0, task);
  const WorkerEvent event = next_event(pool);
  pool.give(0, "more");  // after any ending there is a worker again
  EXPECT_EQ(next_event(pool).text, "did more");
  return event;
}

TEST(WorkerPool, GivesRepliesOfAnyLength) {
  EXPECT_EQ(outcome_of("this").text, "did this");
  EXPECT_EQ(outcome_of("long").text.size(), 3'000'000U);
}

#ifdef CONTORT_ASAN  // ASan handles this signal itself, prints its origin and exits
constexpr const char* kSegfault = "exit 1";
#else
constexpr const char* kSegfault = "SIGSEGV";
#endif

TEST(WorkerPool, NamesTheSignalAndWhatWasBeingDone) {
  for (const auto& [task, name] : std::map<std::string, std::string>{
           {"crash", kSegfault}, {"abort", "SIGABRT"}, {"throw", "SIGABRT"}, {"exit", "exit 3"}}) {
    const WorkerEvent event = outcome_of(task);
    EXPECT_EQ(event.end, WorkerEnd::crashed);
    EXPECT_EQ(event.text, name);
    EXPECT_EQ(event.note, "doing " + task);
  }
}

TEST(WorkerPool, EndsWhatHangsAndWhatEatsMemory) {
  EXPECT_EQ(outcome_of("hang", kTight).end, WorkerEnd::timed_out);
  EXPECT_EQ(outcome_of("eat").end, WorkerEnd::out_of_memory);
}

TEST(WorkerPool, WaitsForWhatShowsThatItIsAlive) {
  EXPECT_EQ(outcome_of("slow but alive", kTight).text, "did slow but alive");
}

TEST(WorkerPool, OthersGoOnWhileOneHangs) {
  WorkerPool pool(2, kTight, obey);
  pool.give(0, "hang");
  int done = 0;
  for (bool hangs = true; hangs;) {
    if (pool.idle_worker() == 1) pool.give(1, "this");
    const WorkerEvent event = next_event(pool);
    if (event.worker == 0)
      hangs = false;
    else
      done += event.text == "did this";
  }
  EXPECT_GT(done, 10);
}

TEST(WorkerPool, LeavesNoProcessBehind) {
  pid_t worker = 0;
  {
    WorkerPool pool(1, kPatient, [](const std::string&, WorkerSlot&) { return std::to_string(::getpid()); });
    pool.give(0, "");
    worker = static_cast<pid_t>(std::stol(next_event(pool).text));
    EXPECT_EQ(::kill(worker, 0), 0);
    pool.give(0, "");
  }
  EXPECT_NE(::kill(worker, 0), 0);
}

}  // namespace
}  // namespace contort
