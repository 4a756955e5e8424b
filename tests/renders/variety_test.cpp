// The order of failures: laws of the distance, of furthest point first, and of the report's rows.
#include "renders/variety.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <set>

namespace contort {
namespace {

std::string pick(const std::vector<std::string>& words) { return *rc::gen::elementOf(words); }

FailureTraits draw_traits(int index) {
  FailureTraits traits;
  traits.check = pick({"joint_range", "pop", "self_collision"});
  traits.subject = pick({"arm_left/elbow max", "arm_right/elbow max", "arm_left/forearm ~ torso/chest", "figure", ""});
  traits.phase = pick({"", "interrupt", "mid_clip"});
  traits.character = pick({"human", "mech"});
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) traits.actions.push_back(pick({"walk", "pose", "reach"}));
  traits.depth = pick({"no", "a"}) == "no" ? 1.0 : static_cast<double>(*rc::gen::inRange(0, 4));
  traits.name = "name_" + std::to_string(index);
  return traits;
}

std::vector<FailureTraits> draw_many() {
  std::vector<FailureTraits> all;
  const int count = *rc::gen::inRange(0, 24);
  for (int i = 0; i < count; ++i) all.push_back(draw_traits(i));
  return all;
}

// Returns the distance to the nearest of the first `count` in the order.
double nearest(const std::vector<FailureTraits>& all, const std::vector<std::size_t>& order, std::size_t count,
               std::size_t one) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, distance(all[order[i]], all[one]));
  return least;
}

bool deeper_or_named_before(const FailureTraits& a, const FailureTraits& b) {
  return a.depth != b.depth ? a.depth > b.depth : a.name < b.name;
}

RC_GTEST_PROP(Variety, DistanceIsAMetric, ()) {
  const FailureTraits a = draw_traits(0), b = draw_traits(1), c = draw_traits(2);
  RC_ASSERT(distance(a, a) == 0.0);
  RC_ASSERT(distance(a, b) == distance(b, a));
  RC_ASSERT(distance(a, b) >= 0.0);
  RC_ASSERT(distance(a, b) <= 1.0 + 1e-12);
  RC_ASSERT(distance(a, c) <= distance(a, b) + distance(b, c) + 1e-12);
}

RC_GTEST_PROP(Variety, EachNextIsFurthestFromThoseBeforeIt, ()) {
  const std::vector<FailureTraits> all = draw_many();
  const std::vector<std::size_t> order = furthest_first(all, all.size());
  RC_ASSERT(std::set<std::size_t>(order.begin(), order.end()).size() == all.size());
  RC_ASSERT(order.size() == all.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const double chosen = i == 0 ? 0.0 : nearest(all, order, i, order[i]);
      const double other = i == 0 ? 0.0 : nearest(all, order, i, order[j]);
      RC_ASSERT(chosen >= other - 1e-12);
      if (i == 0 || chosen == other) RC_ASSERT(deeper_or_named_before(all[order[i]], all[order[j]]));
    }
}

RC_GTEST_PROP(Variety, TheOrderOfTheInputMeansNothing, ()) {
  std::vector<FailureTraits> all = draw_many();
  const auto names = [&] {
    std::vector<std::string> out;
    for (const std::size_t i : furthest_first(all, 7)) out.push_back(all[i].name);
    return out;
  };
  const std::vector<std::string> before = names();
  std::reverse(all.begin(), all.end());
  for (FailureTraits& traits : all) std::reverse(traits.actions.begin(), traits.actions.end());
  RC_ASSERT(names() == before);
}

RC_GTEST_PROP(Variety, AfterTheMostTheRestGoByDepth, ()) {
  const std::vector<FailureTraits> all = draw_many();
  const auto most = static_cast<std::size_t>(*rc::gen::inRange(0, 8));
  const std::vector<std::size_t> whole = furthest_first(all, all.size()), some = furthest_first(all, most);
  RC_ASSERT(some.size() == all.size());
  RC_ASSERT(std::equal(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size())), whole.begin()));
  for (std::size_t i = most; i + 1 < some.size(); ++i)
    RC_ASSERT(deeper_or_named_before(all[some[i]], all[some[i + 1]]));
}

TEST(Variety, WhatSharesWordsIsNearer) {
  const FailureTraits left{"c", "arm_left/forearm ~ torso/chest", "", "human", {"walk", "aim"}, 1.0, "a"};
  FailureTraits right = left, leg = left, fewer = left, other = left;
  right.subject = "arm_right/forearm ~ torso/chest", leg.subject = "leg_left/knee max";
  fewer.actions = {"walk"}, other.actions = {"pose"};
  EXPECT_GT(distance(left, right), 0.0);
  EXPECT_LT(distance(left, right), distance(left, leg));
  EXPECT_LT(distance(left, fewer), distance(left, other));
}

// 60 elbows out of range, deepest of all, and one of each of five other kinds.
TEST(Variety, OneOfEachKindComesBeforeTheSecondOfAny) {
  std::vector<FailureTraits> all;
  for (int i = 0; i < 60; ++i)
    all.push_back({"joint_range", "arm_left/elbow max", "mid_clip", "human", {"pose"}, 100.0 + i, "r" + std::to_string(i)});
  for (const char* check : {"pop", "foot_slide", "balance", "self_collision", "residue"})
    all.push_back({check, "leg_left/knee", "blend", "human", {"walk"}, 1.0, check});
  std::set<std::string> checks;
  const std::vector<std::size_t> order = furthest_first(all, 6);
  for (std::size_t i = 0; i < 6; ++i) checks.insert(all[order[i]].check);
  EXPECT_EQ(checks.size(), 6U);
  EXPECT_EQ(all[order[0]].name, "r59");
}

TEST(Variety, ADepthThatIsNoNumberIsLast) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<FailureTraits> all = {{"c", "s", "", "h", {}, nan, "a"}, {"c", "s", "", "h", {}, 0.0, "b"}};
  EXPECT_EQ(furthest_first(all, 2), (std::vector<std::size_t>{1, 0}));
}

ReportRow row_of(const std::string& family, const std::string& state, bool gating, double depth) {
  ReportRow row;
  row.family = row.check = family, row.state = state, row.gating = gating, row.depth = depth;
  row.key = family + std::to_string(depth);
  return row;
}

TEST(Variety, RowsKeepTheirGroupsAndFamilies) {
  std::vector<ReportRow> rows = {row_of("fixed", "fixed", false, 90), row_of("known", "open", false, 80),
                                 row_of("a", "open", false, 70),      row_of("b", "regressed", true, 2),
                                 row_of("a", "new", true, 1),         row_of("known", "open", false, 85)};
  order_rows(rows);
  std::vector<std::pair<std::string, double>> shown;
  for (const ReportRow& row : rows) shown.emplace_back(row.family, row.depth);
  const std::vector<std::pair<std::string, double>> wanted = {{"b", 2.0},      {"a", 1.0},      {"a", 70.0},
                                                              {"known", 85.0}, {"known", 80.0}, {"fixed", 90.0}};
  EXPECT_EQ(shown, wanted);
}

// A second would be felt after each night; measured: 20 ms in a Release build.
TEST(Variety, ThreeThousandTakeNoTime) {
  std::vector<ReportRow> rows;
  for (int i = 0; i < 3000; ++i) {
    rows.push_back(row_of("family " + std::to_string(i), "new", true, i % 100));
    rows.back().check = "check_" + std::to_string(i % 20);
    rows.back().subject = "human: arm_" + std::to_string(i % 70) + "/joint_" + std::to_string(i % 300) + " max";
    rows.back().actions = {"walk", "action_" + std::to_string(i % 11)};
  }
  const std::clock_t start = std::clock();
  order_rows(rows);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_EQ(rows.size(), 3000U);
  EXPECT_LT(cpu_s, 2.0);
}

}  // namespace
}  // namespace contort
