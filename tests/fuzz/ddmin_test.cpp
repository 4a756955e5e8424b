// Delta debugging: no unit that remains can be removed, and it needs few tries.
#include "fuzz/ddmin.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

namespace contort {

namespace {

struct Reduced {
  std::vector<int> left;
  int tries = 0;
};

Reduced reduce(int size, const std::function<bool(const std::vector<int>&)>& holds) {
  Reduced reduced;
  reduced.left.resize(static_cast<std::size_t>(size));
  std::iota(reduced.left.begin(), reduced.left.end(), 0);
  ddmin([&] { return static_cast<int>(reduced.left.size()); },
        [&](int first, int n) {
          std::vector<int> rest = reduced.left;
          rest.erase(rest.begin() + first, rest.begin() + first + n);
          ++reduced.tries;
          if (!holds(rest)) return false;
          reduced.left = rest;
          return true;
        });
  return reduced;
}

RC_GTEST_PROP(DeltaDebugging, LeavesExactlyWhatIsNeeded, ()) {
  const int size = *rc::gen::inRange(0, 40);
  const auto drawn = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, std::max(1, size)));
  const std::set<int> needed(drawn.begin(), size > 0 ? drawn.end() : drawn.begin());
  const Reduced reduced = reduce(size, [&](const std::vector<int>& rest) {
    return std::includes(rest.begin(), rest.end(), needed.begin(), needed.end());
  });
  RC_ASSERT(reduced.left == std::vector<int>(needed.begin(), needed.end()));
}

// Holds for any half of the units, in any number: the necessary ones depend on which others remain.
RC_GTEST_PROP(DeltaDebugging, NoSingleUnitCanGoAfterwards, ()) {
  const auto salt = *rc::gen::inRange<unsigned>(1, 1000);
  const auto holds = [salt](const std::vector<int>& rest) {
    unsigned mixed = salt;
    for (const int unit : rest) mixed = (mixed ^ static_cast<unsigned>(unit)) * 2654435761U;
    return mixed >> 31 == 0;
  };
  const Reduced reduced = reduce(*rc::gen::inRange(1, 30), holds);
  for (std::size_t i = 0; reduced.left.size() > 1 && i < reduced.left.size(); ++i) {
    std::vector<int> rest = reduced.left;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    RC_ASSERT(!holds(rest));
  }
}

TEST(DeltaDebugging, OneOfAHundredIsFoundInAFewTries) {
  for (int needed = 0; needed < 100; ++needed) {
    const Reduced reduced = reduce(
        100, [&](const std::vector<int>& rest) { return std::find(rest.begin(), rest.end(), needed) != rest.end(); });
    EXPECT_EQ(reduced.left, std::vector<int>{needed});
    EXPECT_LE(reduced.tries, 20);  // measured: 8 to 14
  }
}

TEST(DeltaDebugging, NothingNeededCostsOneTry) {
  EXPECT_EQ(reduce(50, [](const std::vector<int>&) { return true; }).tries, 1);
  EXPECT_EQ(reduce(0, [](const std::vector<int>&) { return true; }).tries, 0);
}

}  // namespace

}  // namespace contort
