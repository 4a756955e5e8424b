#include "fuzz/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace contort {

namespace {

TEST(ParallelFor, DoesEveryIndexOnceForAnyNumberOfThreads) {
  for (const int jobs : {1, 2, 7}) {
    std::vector<std::atomic<int>> done(100);
    std::atomic<int> wrong_worker{0};
    parallel_for(
        jobs, 100,
        [&](int worker, int index) {
          if (worker < 0 || worker >= jobs) ++wrong_worker;
          ++done[static_cast<std::size_t>(index)];
        },
        [] {});
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
    EXPECT_EQ(wrong_worker, 0);
  }
}

TEST(ParallelFor, NothingToDoIsDoneAtOnce) {
  parallel_for(
      4, 0, [](int, int) { FAIL(); }, [] { FAIL(); });
}

}  // namespace

}  // namespace contort
