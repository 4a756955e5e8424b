#include "renders/wording.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "checks/circumstances.h"

namespace contort {
namespace {

TEST(Wording, AddsTheFamiliarUnit) {
  EXPECT_EQ(margin_text(-0.0234, "m"), "-0.0234 m (-23.4 mm)");
  EXPECT_EQ(margin_text(-0.21, "rad"), "-0.21 rad (-12\u00B0)");
  EXPECT_EQ(margin_text(-3.3, "rad/s"), "-3.3 rad/s (-189\u00B0/s)");
  EXPECT_EQ(margin_text(-12.0, "N m"), "-12 N m");
  EXPECT_EQ(margin_text(std::nan(""), "m"), "not a number");
}

// tests/page/case.test.mjs has the same table for the charts.
TEST(Wording, WritesOneNumberInOneWay) {
  const std::pair<double, const char*> kNumbers[] = {
      {0.0, "0"},          {-0.0, "0"},          {0.001, "0.001"},          {0.00012, "1.2e-4"},
      {-0.02345, "-0.0234"}, {1.5, "1.5"},        {12.04, "12"},             {-999.6, "-1\u202F000"},
      {-2002.0, "-2\u202F000"}, {-2e3, "-2\u202F000"}, {3600.4, "3\u202F600"}, {999499.0, "999\u202F000"},
      {999999.0, "1e6"},   {-1.5e9, "-1.5e9"},   {0.0009999, "0.001"}};
  for (const auto& [value, text] : kNumbers) EXPECT_EQ(rounded_text(value), text) << value;
  EXPECT_EQ(rounded_text(std::nan("")), "not a number");
  EXPECT_EQ(rounded_text(-INFINITY), "-infinite");
}

TEST(Wording, WritesShares) {
  EXPECT_EQ(share_text(12, 40), "30 %");
  EXPECT_EQ(share_text(1, 3), "33.3 %");
  EXPECT_EQ(share_text(0, 3), "0 %");
  EXPECT_EQ(share_text(1, 100000), "less than 0.1 %");
}

TEST(Wording, HasNoTimeWithoutARate) {
  EXPECT_EQ(time_text(73, 60.0), "1.217 s");
  EXPECT_EQ(time_text(73, 0.0), "");
  EXPECT_EQ(time_text(73, std::nan("")), "");
}

TEST(Wording, GroupsDigits) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1234567), "1\u202F234\u202F567");
  EXPECT_EQ(count_text(-1000), "-1\u202F000");
  EXPECT_EQ(count_text(-100), "-100");
  EXPECT_EQ(counted(1, "case", "cases"), "1 case");
  EXPECT_EQ(counted(2, "case", "cases"), "2 cases");
}

TEST(OneLine, KeepsGoodTextAndCutsLongText) {
  EXPECT_EQ(one_line("arm_left/ellenb\u00F6gen \u4E2D"), "arm_left/ellenb\u00F6gen \u4E2D");
  EXPECT_EQ(one_line("abcdef", 6), "abcdef");
  EXPECT_EQ(one_line("abcdefg", 6), "abcde\u2026");
  EXPECT_EQ(one_line("abc", 0), "");
}

TEST(OneLine, ReplacesWhatIsNotText) {
  EXPECT_EQ(one_line("a\nb\tc\x7f"), "a\uFFFDb\uFFFDc\uFFFD");
  EXPECT_EQ(one_line("\xff\xc0\xaf"), "\uFFFD\uFFFD\uFFFD");  // never a lead byte; overlong
  EXPECT_EQ(one_line("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // a surrogate
  EXPECT_EQ(one_line("\xe2\x82"), "\uFFFD\uFFFD");            // cut off
  EXPECT_EQ(one_line("a\u202Eb"), "a\uFFFD\uFFFD\uFFFDb");    // writes backwards
  EXPECT_EQ(one_line(std::string_view("a\0b", 3)), "a\uFFFDb");
}

RC_GTEST_PROP(OneLine, ChangesItsOwnResultNoMore, (const std::string& bytes)) {
  RC_ASSERT(one_line(one_line(bytes)) == one_line(bytes));
}

TEST(PhaseText, SaysEachPhaseInWords) {
  for (const std::string_view phase : phase_names()) EXPECT_NE(phase_text(phase), phase) << phase;
  EXPECT_EQ(phase_text("interrupt"), "just after an interrupt");
  EXPECT_EQ(phase_text("of_tomorrow"), "of_tomorrow");
  EXPECT_EQ(phase_text(""), "");
}

}  // namespace
}  // namespace contort
