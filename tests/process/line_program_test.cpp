// Programs that answer line by line: their answers and endings.
#include "process/line_program.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "process/clock.h"

namespace contort {
namespace {

std::vector<std::string> shell_program(const std::string& script) { return {"/bin/sh", "-c", script}; }

constexpr WorkerLimits kUnhurried{60.0, std::int64_t{1} << 30};

TEST(LinePrograms, AnswerLineByLine) {
  LineProgram cat(shell_program("exec cat"), kUnhurried, Messages::dropped);
  for (const std::string& text : {std::string("one"), std::string(), std::string(3 << 20, 'x')}) {
    cat.send_line(text);
    const Ending ending = cat.read_line();
    EXPECT_EQ(ending.kind, Ending::Kind::finished);
    EXPECT_EQ(ending.result.size(), text.size());
    EXPECT_TRUE(ending.result == text);
  }
}

TEST(LinePrograms, MaySayMoreThanOneLineAtOnce) {
  LineProgram two(shell_program("printf 'a\\nb\\n'; exec sleep 100"), kUnhurried, Messages::dropped);
  EXPECT_EQ(two.read_line().result, "a");
  EXPECT_EQ(two.read_line().result, "b");
}

TEST(LinePrograms, ThatEndSayHow) {
  LineProgram gone(shell_program("exit 3"), kUnhurried, Messages::dropped);
  EXPECT_EQ(gone.read_line(), (Ending{Ending::Kind::crash, "exit 3", ""}));
  gone.send_line("nobody reads this");
  EXPECT_EQ(gone.read_line(), (Ending{Ending::Kind::crash, "exit 3", ""})) << "and say the same again";
  LineProgram killed(shell_program("printf 'half a line'; kill -SEGV $$"), kUnhurried, Messages::dropped);
  EXPECT_EQ(killed.read_line(), (Ending{Ending::Kind::crash, "SIGSEGV", ""}));
  LineProgram nothing({"/no/such/program"}, kUnhurried, Messages::dropped);
  EXPECT_EQ(nothing.read_line(), (Ending{Ending::Kind::crash, "exit 127", ""}));
}

TEST(LinePrograms, ThatHangAreEnded) {
  LineProgram silent(shell_program("exec sleep 1000"), {0.2, kUnhurried.bytes}, Messages::dropped);
  int waited = 0;
  EXPECT_EQ(silent.read_line([&] { ++waited; }).kind, Ending::Kind::timeout);
  EXPECT_GE(waited, 1);
  EXPECT_EQ(silent.read_line().kind, Ending::Kind::timeout);
}

TEST(LinePrograms, ThatReadNothingAreEnded) {
  LineProgram deaf(shell_program("exec sleep 1000"), {0.2, kUnhurried.bytes}, Messages::dropped);
  deaf.send_line(std::string(8 << 20, 'x'));  // more than any socket holds
  EXPECT_EQ(deaf.read_line().kind, Ending::Kind::timeout);
}

TEST(LinePrograms, ThatTakeTooMuchMemoryAreEnded) {
  LineProgram hungry(shell_program("x=$(head -c 40000000 /dev/zero | tr '\\0' x); echo done; exec sleep 1000"),
                     {60.0, 20 << 20}, Messages::dropped);
  EXPECT_EQ(hungry.read_line().kind, Ending::Kind::memory);
}

TEST(LinePrograms, CloseTheirOutputAsAnEnd) {
  const double start_s = steady_s();
  LineProgram closed(shell_program("exec sleep 1000 >&- <&-"), kUnhurried, Messages::dropped);
  EXPECT_EQ(closed.read_line().kind, Ending::Kind::crash);
  EXPECT_LT(steady_s() - start_s, 30.0) << "it was killed, not waited for";
}

TEST(LinePrograms, EndWithTheirObject) {
  int pid = 0;
  {
    LineProgram named(shell_program("echo $$; exec sleep 1000"), kUnhurried, Messages::dropped);
    pid = std::atoi(named.read_line().result.c_str());
    ASSERT_GT(pid, 0);
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_NE(::kill(pid, 0), 0);
}

}  // namespace
}  // namespace contort
