#include "process/children.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

TEST(Children, GoOnBehindACallThatEndsItsProcess) {
  const TempFolder folder;
  const auto work = [&](int i) {
    if (i == 3) ::raise(SIGKILL);
    if (i == 6) ::pause();  // for ever
    if (i == 7) throw std::runtime_error("a test throws this");
    std::ofstream(folder / std::to_string(i)) << i;
  };
  int most = 0;
  const std::vector<int> lost = in_children(2, 11, 1, work, [&](int done) { most = std::max(most, done); });
  EXPECT_EQ(lost, (std::vector<int>{3, 6, 7}));
  for (int i = 0; i < 11; ++i)
    EXPECT_EQ(std::filesystem::exists(folder / std::to_string(i)), i != 3 && i != 6 && i != 7) << i;
  EXPECT_LE(most, 11);
  EXPECT_GE(most, 6) << "while the last call hung";
}

// A parent that is killed cannot end its children itself.
TEST(Children, EndWithTheirParentHoweverItEnds) {
  const TempFolder folder;
  const auto said = [&] { return slurp(folder / "pid"); };
  const pid_t parent = ::fork();
  if (parent == 0) {
    const auto work = [&](int) {
      std::ofstream(folder / "pid") << ::getpid() << "\n" << std::flush;
      ::pause();
    };
    (void)in_children(1, 1, 1000, work, [](int) {});
    ::_exit(0);
  }
  for (int i = 0; i < 6000 && !said().ends_with("\n"); ++i) ::usleep(10'000);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  const int child = std::atoi(said().c_str());
  ASSERT_GT(child, 0);
  const auto is_running = [&] {
    const std::string stat = slurp("/proc/" + std::to_string(child) + "/stat");
    return !stat.empty() && stat.substr(stat.rfind(')') + 2, 1) != "Z";
  };
  for (int i = 0; i < 6000 && is_running(); ++i) ::usleep(10'000);
  EXPECT_FALSE(is_running());
}

TEST(Children, HaveNothingToDo) {
  EXPECT_TRUE(in_children(
                  4, 0, 1, [](int) {}, [](int) {})
                  .empty());
  EXPECT_TRUE(in_children(
                  4, 2, 1, [](int) {}, [](int) {})
                  .empty());
}

}  // namespace
}  // namespace contort
