// The words for a difference between two builds: broke, worse, mended, moved, refused.
#include "fuzz/comparison.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace contort {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const CompareRules kPopAndRange{0.1, {"pop", "joint_range"}};

Measurement measured(const std::string& hash, std::vector<SubjectMargin> findings, const std::string& trace = "") {
  Measurement one;
  one.motion_hash = hash, one.trace = trace, one.findings = std::move(findings);
  return one;
}

Comparison compared(const std::vector<SubjectMargin>& ours, const std::vector<SubjectMargin>& base) {
  return compare("human", measured("aa", ours), measured("aa", base), kPopAndRange);
}

std::vector<Family> pop_of(const std::string& subject) { return {{"pop", "human", subject}}; }

// Findings with depths around the tolerance; some are not finite.
std::vector<SubjectMargin> some_findings() {
  static const std::vector<double> kMargins = {-0.01, -0.1, -0.11, -0.5, -1.2, -2.5, -7.0, kNaN};
  std::vector<SubjectMargin> findings;
  for (const char* check : {"joint_range", "pop"})
    for (const char* subject : {"elbow", "knee"})
      if (*rc::gen::arbitrary<bool>())
        findings.push_back({check, subject, *rc::gen::elementOf(kMargins), *rc::gen::inRange(0, 4) == 0});
  return findings;
}

RC_GTEST_PROP(Comparisons, OfEqualBuildsAreEmpty, ()) {
  const std::vector<SubjectMargin> findings = some_findings();
  const Comparison same = compared(findings, findings);
  RC_ASSERT(same.broke.empty() && same.worse.empty() && same.mended.empty());
  RC_ASSERT(!same.moved && same.refusal.empty() && same.first_difference == -1);
}

RC_GTEST_PROP(Comparisons, TurnBreakingIntoMendingWhenTheBuildsChangePlaces, ()) {
  std::vector<SubjectMargin> ours = some_findings(), base = some_findings();
  for (auto* findings : {&ours, &base})
    for (SubjectMargin& finding : *findings) finding.waived = false;
  RC_ASSERT(compared(ours, base).broke == compared(base, ours).mended);
  RC_ASSERT(compared(ours, base).mended == compared(base, ours).broke);
}

RC_GTEST_PROP(Comparisons, PutAFamilyInOneListOnly, ()) {
  const Comparison both = compared(some_findings(), some_findings());
  std::vector<Family> all = both.broke;
  all.insert(all.end(), both.worse.begin(), both.worse.end());
  all.insert(all.end(), both.mended.begin(), both.mended.end());
  std::ranges::sort(all);
  RC_ASSERT(std::ranges::adjacent_find(all) == all.end());
  RC_ASSERT(std::ranges::is_sorted(both.broke));
}

TEST(Comparisons, LetAFailureBreakOnlyBeyondTheTolerance) {
  EXPECT_EQ(change_between(0.11, std::nullopt, 0.1), Change::broke);
  EXPECT_EQ(change_between(0.1, std::nullopt, 0.1), std::nullopt);
  EXPECT_EQ(change_between(0.1, std::nullopt, 0.0), Change::broke);
  EXPECT_EQ(change_between(std::nullopt, 0.11, 0.1), Change::mended);
  EXPECT_EQ(change_between(std::nullopt, 0.1, 0.1), std::nullopt);
  EXPECT_EQ(change_between(std::nullopt, std::nullopt, 0.1), std::nullopt);
}

TEST(Comparisons, AskTwiceTheDepthAndOneScaleOfWhatGotWorse) {
  EXPECT_EQ(change_between(2.0, 1.0, 0.1), Change::worse);
  EXPECT_EQ(change_between(1.9, 0.9, 0.1), Change::worse);
  EXPECT_EQ(change_between(1.8, 0.9, 0.1), std::nullopt) << "twice as deep, but not by one scale";
  EXPECT_EQ(change_between(5.9, 3.0, 0.1), std::nullopt) << "by more than one scale, but not twice as deep";
  EXPECT_EQ(change_between(1.0, 2.0, 0.1), std::nullopt);
}

TEST(Comparisons, TakeNotFiniteMarginsAsInfinitelyDeep) {
  EXPECT_EQ(change_between(kInfinite, std::nullopt, 0.1), Change::broke);
  EXPECT_EQ(change_between(kInfinite, 3.0, 0.1), Change::worse);
  EXPECT_EQ(change_between(kInfinite, kInfinite, 0.1), std::nullopt);
  EXPECT_EQ(change_between(3.0, kInfinite, 0.1), std::nullopt);
  EXPECT_EQ(compared({{"pop", "knee", kNaN}}, {}).broke, pop_of("knee"));
  EXPECT_EQ(compared({{"pop", "knee", kNaN}}, {{"pop", "knee", -3.0}}).worse, pop_of("knee"));
}

TEST(Comparisons, LeaveOutChecksThatOneBuildLacks) {
  EXPECT_TRUE(compared({{"stuck", "knee", -9.0}}, {}).broke.empty());
  EXPECT_TRUE(compared({}, {{"stuck", "knee", -9.0}}).mended.empty());
  EXPECT_EQ(compared({{"pop", "knee", -9.0}}, {}).broke, pop_of("knee"));
}

TEST(Comparisons, NeverCountWaivedFailures) {
  EXPECT_TRUE(compared({{"pop", "knee", -9.0, true}}, {}).broke.empty());
  EXPECT_TRUE(compared({{"pop", "knee", -9.0}}, {{"pop", "knee", -9.0, true}}).broke.empty());
  EXPECT_TRUE(compared({{"pop", "knee", -9.0, true}}, {{"pop", "knee", -9.0}}).mended.empty()) << "it is still there";
}

TEST(Comparisons, NameTheFirstFrameThatDiffers) {
  const auto first = [](const std::string& ours, const std::string& base) {
    return compare("human", measured("aa", {}, ours), measured("bb", {}, base), kPopAndRange).first_difference;
  };
  EXPECT_EQ(first("000011112222", "000011112223"), 2);
  EXPECT_EQ(first("000011112222", "90001111222"), 0);
  EXPECT_EQ(first("00001111", "000011112222"), 2) << "one motion ends there";
  EXPECT_EQ(first("00001111", ""), -1);
  const Comparison equal = compare("human", measured("aa", {}, "0000"), measured("aa", {}, "1111"), kPopAndRange);
  EXPECT_FALSE(equal.moved);
  EXPECT_EQ(equal.first_difference, -1);
}

TEST(Comparisons, HaveNothingElseWhereTheBaseRefuses) {
  Measurement base;
  base.refusal = Issue{"spec.unknown_action", "/sequences/0", "there is no action"};
  const Comparison refused = compare("human", measured("aa", {{"pop", "knee", -9.0}}), base, kPopAndRange);
  EXPECT_EQ(refused.refusal, "spec.unknown_action at /sequences/0: there is no action");
  EXPECT_TRUE(refused.broke.empty());
  EXPECT_FALSE(refused.moved);
}

TEST(Comparisons, CutALongReasonBetweenCharacters) {
  Measurement base;
  std::string text;
  for (int i = 0; i < 400; ++i) text += "\u00e9";
  for (const char* code : {"a", "ab"}) {
    base.refusal = Issue{code, "", text};
    const std::string cut = refusal_text(base);
    EXPECT_LE(cut.size(), 503U);
    EXPECT_GE(cut.size(), 500U);
    EXPECT_TRUE(cut.ends_with("\u00e9\u2026")) << cut;
  }
}

TEST(Comparisons, SayWhatTheBaseShowsForAFailure) {
  const auto shows = [](double depth, std::vector<SubjectMargin> base) {
    return base_shows(depth, "pop", "knee", measured("aa", std::move(base)), kPopAndRange);
  };
  EXPECT_EQ(shows(1.0, {}), BaseShows::passes_check);
  EXPECT_EQ(shows(1.0, {{"joint_range", "knee", -1.0}}), BaseShows::passes_check);
  EXPECT_EQ(shows(1.0, {{"pop", "hip", -0.01}}), BaseShows::passes);
  EXPECT_EQ(shows(3.0, {{"pop", "knee", -1.0}}), BaseShows::milder);
  EXPECT_EQ(shows(1.0, {{"pop", "knee", -1.0}}), std::nullopt);
  EXPECT_EQ(shows(0.05, {}), std::nullopt);
  EXPECT_EQ(base_shows(1.0, "stuck", "knee", measured("aa", {}), kPopAndRange), std::nullopt);
}

}  // namespace
}  // namespace contort
