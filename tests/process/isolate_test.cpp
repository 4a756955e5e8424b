// Work that ends abnormally ends only its own process, and leaves nothing behind.
#include "corpus/ending_case.h"
#include "process/isolate.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

namespace contort {

namespace {

Ending ending_of(const std::function<std::string()>& work, int seconds = 20) {
  Isolation isolation;
  isolation.seconds = seconds;
  isolation.silent = true;
  const Result<Ending> ending = isolate(work, isolation);
  if (!ending) ADD_FAILURE() << to_line(ending.issue());
  errno = 0;
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
  EXPECT_EQ(errno, ECHILD);
  return ending ? *ending : Ending{};
}

std::string hang() {
  for (;;) ::pause();
}

TEST(Isolate, FinishedWorkReturnsItsResult) {
  const std::string large(3 << 20, 'x');  // more than a pipe holds
  for (const std::string& result : {std::string(), std::string("a\0b.", 4), large}) {
    const Ending ending = ending_of([&] { return result; });
    EXPECT_EQ(ending.kind, Ending::Kind::finished);
    EXPECT_EQ(ending.result, result);
  }
}

TEST(Isolate, WhatTheWorkChangesStaysWithIt) {
  int value = 1;
  ending_of([&] { return value = 2, std::string(); });
  EXPECT_EQ(value, 1);
}

TEST(Isolate, ACrashIsNamedByItsSignal) {
  for (const auto& [number, name] : {std::pair(SIGSEGV, "SIGSEGV"), std::pair(SIGFPE, "SIGFPE"),
                                     std::pair(SIGBUS, "SIGBUS"), std::pair(SIGKILL, "SIGKILL")}) {
    const Ending ending = ending_of([n = number] { return ::raise(n), std::string(); });
    EXPECT_EQ(ending.kind, Ending::Kind::crash);
    EXPECT_EQ(ending.signal, name);
  }
}

TEST(Isolate, AnAssertAndAnExceptionEndByAbort) {
  EXPECT_EQ(ending_of([]() -> std::string { std::abort(); }).signal, "SIGABRT");
  EXPECT_EQ(ending_of([]() -> std::string { throw std::runtime_error("no"); }).signal, "SIGABRT");
}

TEST(Isolate, LeavingHalfWayIsACrash) {
  EXPECT_EQ(ending_of([]() -> std::string { ::_exit(3); }).signal, "exit 3");
  EXPECT_EQ(ending_of([]() -> std::string { ::_exit(0); }).signal, "exit 0");
}

TEST(Isolate, WhatHangsOrSpinsTimesOut) {
  EXPECT_EQ(ending_of(hang, 1).kind, Ending::Kind::timeout);
  const auto spin = []() -> std::string {
    for (std::atomic<unsigned> i = 0;; ++i) {
    }
  };
  EXPECT_EQ(ending_of(spin, 1).kind, Ending::Kind::timeout);
}

TEST(Isolate, WorkThatEatsMemoryIsStopped) {
  Isolation isolation;
  isolation.resident_bytes = std::int64_t{600} << 20;  // this process has some too
  const Result<Ending> ending = isolate(
      [] {
        std::vector<std::string> eaten;
        for (int i = 0; i < 200; ++i) eaten.emplace_back(std::size_t{16} << 20, 'x');  // 3.2 GB in all
        return std::string();
      },
      isolation);
  ASSERT_TRUE(ending) << to_line(ending.issue());
  EXPECT_EQ(ending->kind, Ending::Kind::memory);
}

std::string handlers() {
  std::string text;
  for (int number = 1; number < NSIG; ++number) {
    struct sigaction now {};
    if (::sigaction(number, nullptr, &now) == 0)
      text +=
          std::to_string(reinterpret_cast<std::uintptr_t>(now.sa_handler)) + "/" + std::to_string(now.sa_flags) + " ";
  }
  sigset_t blocked;
  ::sigprocmask(SIG_SETMASK, nullptr, &blocked);
  for (int number = 1; number < NSIG; ++number) text += ::sigismember(&blocked, number) == 1 ? "1" : "0";
  return text;
}

TEST(Isolate, SignalHandlersAndTheAlarmOfTheCallerStayAsTheyAre) {
  const std::string before = handlers();
  ::alarm(1000);
  ending_of([]() -> std::string { std::abort(); });
  EXPECT_GT(::alarm(0), 900U);
  EXPECT_EQ(handlers(), before);
}

bool is_alive(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return (status >> number >> name >> state) && state != "Z";
}

TEST(Isolate, TheChildOfACallerThatIsKilledGoesWithIt) {
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const pid_t caller = ::fork();
  if (caller == 0) {
    const auto work = [&] {
      const pid_t own = ::getpid();
      if (::write(pipe[1], &own, sizeof own) != sizeof own) ::_exit(1);
      return hang();
    };
    ::_exit(isolate(work) ? 0 : 1);
  }
  pid_t child = 0;
  ASSERT_EQ(::read(pipe[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
  EXPECT_TRUE(is_alive(child));
  ::kill(caller, SIGKILL);
  ::waitpid(caller, nullptr, 0);
  for (int i = 0; i < 500 && is_alive(child); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(is_alive(child));
  ::close(pipe[0]);
  ::close(pipe[1]);
}

TEST(Isolate, EndingsMakeCasesOfTheirOwnFamilies) {
  Spec spec;
  spec.character.name = "mech";
  const auto family = [&](const Ending& ending) { return print_family(family_of(ending_case(spec, ending))); };
  EXPECT_EQ(family({Ending::Kind::crash, "SIGSEGV", ""}), "crash|mech|SIGSEGV");
  EXPECT_EQ(family({Ending::Kind::timeout, "", ""}), "timeout|mech|evaluation");
  EXPECT_EQ(family({Ending::Kind::memory, "", ""}), "memory|mech|evaluation");
}

}  // namespace

}  // namespace contort
