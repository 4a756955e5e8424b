// Compares the fold from margins to episodes with a reference that uses whole rows instead of a state.
#include "checks/fold.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/checks/family_text.h"

namespace contort {

namespace {

using Episode = MarginFold::Episode;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A margin, or -infinity's opposite: "not judged in this frame" is +infinity that is never reported.
struct Sample {
  bool judged = true;
  double margin = 0.0;
};
using Row = std::vector<Sample>;

bool violated(const Sample& s) { return s.judged && !(s.margin >= 0.0); }
bool worse(double a, double b) { return std::isnan(a) ? !std::isnan(b) : a < b; }

std::vector<Episode> reference(const Row& row, int gap, int subject) {
  std::vector<Episode> out;
  int safe = 0;
  for (int f = 0; f < static_cast<int>(row.size()); ++f) {
    const Sample& s = row[static_cast<std::size_t>(f)];
    safe = violated(s) ? 0 : safe + 1;
    if (!violated(s)) continue;
    const bool joins = !out.empty() && f - out.back().last - 1 <= gap;
    if (!joins) out.push_back({subject, f, f, f, s.margin});
    out.back().last = f;
    if (worse(s.margin, out.back().worst_margin)) out.back().worst = f, out.back().worst_margin = s.margin;
  }
  return out;
}

bool same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
bool same(const Episode& a, const Episode& b) {
  return a.subject == b.subject && a.first == b.first && a.worst == b.worst && a.last == b.last &&
         same_number(a.worst_margin, b.worst_margin);
}

MarginFold fold_rows(const std::vector<Row>& rows, int gap) {
  MarginFold fold(static_cast<int>(rows.size()), gap);
  const std::size_t frames = rows.empty() ? 0 : rows.front().size();
  for (std::size_t f = 0; f < frames; ++f)
    for (std::size_t s = 0; s < rows.size(); ++s)
      if (rows[s][f].judged) fold.report(static_cast<int>(s), static_cast<int>(f), rows[s][f].margin);
  return fold;
}

Row row_of(std::initializer_list<double> margins) {
  Row row;
  for (const double margin : margins) row.push_back({true, margin});
  return row;
}

rc::Gen<Sample> sample() {
  return rc::gen::map(rc::gen::inRange(0, 14), [](int n) -> Sample {
    if (n == 0) return {false, 0.0};
    if (n == 1) return {true, kNaN};
    if (n == 2) return {true, -0.0};
    if (n == 3) return {true, -kInfinity};
    return {true, n < 9 ? static_cast<double>(n - 9) : static_cast<double>(n - 8)};  // -5 … -1, 1 … 5
  });
}

std::vector<Row> draw_rows() {
  const int subjects = *rc::gen::inRange(1, 5);
  const auto frames = static_cast<std::size_t>(*rc::gen::inRange(0, 40));
  std::vector<Row> rows;
  for (int s = 0; s < subjects; ++s) rows.push_back(*rc::gen::container<Row>(frames, sample()));
  return rows;
}

RC_GTEST_PROP(Fold, AgreesWithAReferenceThatSeesWholeRows, ()) {
  const std::vector<Row> rows = draw_rows();
  const int gap = *rc::gen::inRange(0, 5);
  std::vector<Episode> expected;
  for (std::size_t s = 0; s < rows.size(); ++s)
    for (const Episode& e : reference(rows[s], gap, static_cast<int>(s))) expected.push_back(e);
  std::sort(expected.begin(), expected.end(), [](const Episode& a, const Episode& b) {
    return std::pair(a.first, a.subject) < std::pair(b.first, b.subject);
  });
  const std::vector<Episode> got = fold_rows(rows, gap).episodes();
  RC_ASSERT(std::equal(got.begin(), got.end(), expected.begin(), expected.end(), same));
}

RC_GTEST_PROP(Fold, IntervalsCoverTheViolatedFramesAndNoGapLongerThanAllowed, ()) {
  const std::vector<Row> rows = draw_rows();
  const int gap = *rc::gen::inRange(0, 5);
  const std::vector<Episode> episodes = fold_rows(rows, gap).episodes();
  for (std::size_t s = 0; s < rows.size(); ++s) {
    int last_end = -gap - 2;
    std::vector<int> cover(rows[s].size(), 0);
    for (const Episode& e : episodes) {
      if (e.subject != static_cast<int>(s)) continue;
      RC_ASSERT(e.first - last_end > gap + 1);
      last_end = e.last;
      int safe = 0;
      for (int f = e.first; f <= e.last; ++f) {
        const auto at = static_cast<std::size_t>(f);
        ++cover[at];
        safe = violated(rows[s][at]) ? 0 : safe + 1;
        RC_ASSERT(safe <= gap);
      }
      RC_ASSERT(safe == 0);
    }
    for (std::size_t f = 0; f < cover.size(); ++f) RC_ASSERT((violated(rows[s][f]) ? cover[f] == 1 : cover[f] <= 1));
  }
}

RC_GTEST_PROP(Fold, WorstIsTheLeastMarginOfTheEpisodeAndItsFirstFrame, ()) {
  const std::vector<Row> rows = draw_rows();
  for (const Episode& e : fold_rows(rows, 2).episodes()) {
    const Row& row = rows[static_cast<std::size_t>(e.subject)];
    RC_ASSERT(same_number(row[static_cast<std::size_t>(e.worst)].margin, e.worst_margin));
    for (int f = e.first; f <= e.last; ++f) {
      const Sample& s = row[static_cast<std::size_t>(f)];
      if (!violated(s)) continue;
      RC_ASSERT(!worse(s.margin, e.worst_margin));
      RC_ASSERT(f >= e.worst || worse(e.worst_margin, s.margin));
    }
  }
}

RC_GTEST_PROP(Fold, SmallestIsTheLeastMarginOfEachSubject, ()) {
  const std::vector<Row> rows = draw_rows();
  const MarginFold fold = fold_rows(rows, 1);
  for (std::size_t s = 0; s < rows.size(); ++s) {
    double least = kInfinity;
    for (const Sample& x : rows[s])
      if (x.judged && (worse(x.margin, least) || std::isnan(x.margin))) least = x.margin;
    RC_ASSERT(same_number(fold.smallest()[s], least));
  }
}

RC_GTEST_PROP(Fold, OneSubjectDoesNotTouchAnother, ()) {
  const std::vector<Row> rows = draw_rows();
  const std::vector<Episode> together = fold_rows(rows, 2).episodes();
  for (std::size_t s = 0; s < rows.size(); ++s) {
    std::vector<Episode> mine;
    for (Episode e : together)
      if (e.subject == static_cast<int>(s)) e.subject = 0, mine.push_back(e);
    const std::vector<Episode> alone = fold_rows({rows[s]}, 2).episodes();
    RC_ASSERT(std::equal(mine.begin(), mine.end(), alone.begin(), alone.end(), same));
  }
}

TEST(Fold, ZeroIsTheLimitAndNotAViolation) {
  EXPECT_TRUE(fold_rows({row_of({0.0, -0.0, 1e-300})}, 2).episodes().empty());
  EXPECT_EQ(fold_rows({row_of({-5e-324})}, 2).episodes().size(), 1U);
}

TEST(Fold, MarginsDownToTheResolutionAreZero) {
  MarginFold fold(1, 2, 1e-9);
  fold.report(0, 0, -1e-9);
  EXPECT_TRUE(fold.episodes().empty());
  fold.report(0, 1, -1.1e-9);
  ASSERT_EQ(fold.episodes().size(), 1U);
  EXPECT_EQ(fold.episodes()[0].first, 1);
  EXPECT_EQ(fold.smallest()[0], -1.1e-9);
}

TEST(Fold, SafeFramesUpToTheGapJoinAndOneMoreSplits) {
  const Row two_apart = row_of({-1, 1, 1, -1});
  EXPECT_EQ(fold_rows({two_apart}, 2).episodes().size(), 1U);
  EXPECT_EQ(fold_rows({two_apart}, 1).episodes().size(), 2U);
  EXPECT_EQ(fold_rows({row_of({-1, 1, -1})}, 0).episodes().size(), 2U);
  EXPECT_EQ(fold_rows({row_of({-1, -1})}, 0).episodes().size(), 1U);
}

TEST(Fold, NaNCountsAsViolatedAndStaysTheWorst) {
  const std::vector<Episode> episodes = fold_rows({row_of({-3, kNaN, -9, kNaN, 1})}, 2).episodes();
  ASSERT_EQ(episodes.size(), 1U);
  EXPECT_TRUE(std::isnan(episodes[0].worst_margin));
  EXPECT_EQ(episodes[0].worst, 1);
  EXPECT_EQ(episodes[0].last, 3);
}

TEST(Fold, AFoldThatWasToldNothingHasNoEpisodesAndInfiniteMargins) {
  const MarginFold fold(2, 2);
  EXPECT_TRUE(fold.episodes().empty());
  EXPECT_EQ(fold.smallest(), std::vector<double>(2, kInfinity));
}

TEST(Fold, AFamilyHoldsNoNumbers) {
  Finding a{"joint_range", "arm_left/elbow max", "rad", 1, 2, 3, -0.5, 5.0};
  Finding b = a;
  b.first_frame = 9, b.worst_margin = -0.1;
  EXPECT_EQ(family_of("human", a), family("joint_range|human|arm_left/elbow max"));
  EXPECT_EQ(family_of("human", a), family_of("human", b));
}

RC_GTEST_PROP(Fold, MarginsFromWhereTheyDoNotMatterChangeNothing, ()) {
  const auto margins = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-6, 12));
  MarginFold all(1, 1, 2.0), some(1, 1, 2.0);
  for (int frame = 0; frame < static_cast<int>(margins.size()); ++frame) {
    const int drawn = margins[static_cast<std::size_t>(frame)];
    const double margin = drawn == 11 ? kNaN : static_cast<double>(drawn);
    all.report(0, frame, margin);
    if (!(margin >= some.matters_below(0))) some.report(0, frame, margin);
  }
  RC_ASSERT(all.episodes().size() == some.episodes().size());
  for (std::size_t e = 0; e < all.episodes().size(); ++e) {
    RC_ASSERT(all.episodes()[e].first == some.episodes()[e].first);
    RC_ASSERT(all.episodes()[e].worst == some.episodes()[e].worst);
    RC_ASSERT(all.episodes()[e].last == some.episodes()[e].last);
  }
  const double smallest = all.smallest()[0];
  RC_ASSERT((std::isnan(smallest) ? std::isnan(some.smallest()[0]) : smallest == some.smallest()[0]));
}

TEST(Fold, EveryMarginMattersWhereTheyAreRecordedOrTolerated) {
  MarginFold recorded(1, 1), tolerated(1, 1);
  recorded.record(1);
  tolerated.tolerate({0.5}, {}, 1);
  EXPECT_EQ(recorded.matters_below(0), kInfinity);
  EXPECT_EQ(tolerated.matters_below(0), kInfinity);
}

}  // namespace

}  // namespace contort
