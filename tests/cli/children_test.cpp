#include "cli/children.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>

#include "tests/corpus/temp_folder.h"

namespace contort::cli {
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

TEST(Children, HaveNothingToDo) {
  EXPECT_TRUE(in_children(4, 0, 1, [](int) {}, [](int) {}).empty());
  EXPECT_TRUE(in_children(4, 2, 1, [](int) {}, [](int) {}).empty());
}

}  // namespace
}  // namespace contort::cli
