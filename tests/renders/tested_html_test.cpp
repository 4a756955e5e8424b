// The part of the page about tested and never tested items.
#include "renders/tested_html.h"

#include <gtest/gtest.h>

#include "renders/check_words.h"

namespace contort {
namespace {

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(Tested, OfNothingThereIsNothing) { EXPECT_EQ(tested_html({}), ""); }

TEST(Tested, ListsWhatWasTested) {
  ReportModel model;
  model.tested = {{"ground plane", 100}, {"ground steps", 0}};
  const std::string html = tested_html(model);
  EXPECT_TRUE(contains(html, "ground plane</th><td>100</td>"));
  EXPECT_TRUE(contains(html, "<tr class='never'><th scope='row'>ground steps"));
  EXPECT_TRUE(contains(html, "width='100.00'"));
}

TEST(Tested, ShowsActionsBySlotPriorityAndPhase) {
  ReportModel model;
  model.tested = {{"action reach (ik) on arm_left", 7},
                  {"action reach (ik) on arm_left in blend", 5},
                  {"action reach (ik) on arm_right", 0}};
  const std::string html = tested_html(model);
  // impact, interrupt, clip_switch: never
  const std::string never = "<td class='never'>0</td>";
  EXPECT_TRUE(contains(html, "<tr><th scope='row'>reach</th><td>ik</td><td>arm_left</td><td>7</td>" + never + never +
                                 never + "<td>5</td>" + never + "</tr>"));
  EXPECT_TRUE(contains(html, "<tr class='never'><th scope='row'>reach</th><td>ik</td><td>arm_right</td>" + never));
  EXPECT_FALSE(contains(html, "part of a case")) << "nothing else was counted";
}

TEST(Tested, SaysWhichPairsNeverWereDrawn) {
  ReportModel model;
  model.tested = {{"pair aim + pose on arm_left", 3}, {"pair aim + reach on arm_left", 0}};
  EXPECT_TRUE(contains(tested_html(model), "1 of 2 were drawn (50 %)"));
  EXPECT_TRUE(contains(tested_html(model), "<li>aim + reach on arm_left</li>"));
  EXPECT_FALSE(contains(tested_html(model), "<li>aim + pose on arm_left</li>"));
  model.tested.pop_back();
  EXPECT_FALSE(contains(tested_html(model), "Those that never were"));
}

TEST(Tested, OfManyPairsSomeAreListed) {
  ReportModel model;
  for (int i = 0; i < 1200; ++i) model.tested.emplace_back("pair a + b" + std::to_string(i) + " on arm_left", 0);
  EXPECT_TRUE(contains(tested_html(model), "<li>and 700 more</li>"));
}

// Both lists give the reason in plain words, the most frequent line first.
TEST(Tested, ListsUnmetRequestsAndChecksThatCouldNotJudge) {
  ReportModel model;
  EXPECT_FALSE(contains(tested_html(model), "id='unmet'"));
  model.unmet = {{"aim on head: joint_speed", 3}, {"reach on arm_left: out_of_reach", 12}};
  model.not_judged = {{"balance: the motion has no dynamics", 2}};
  const std::string html = tested_html(model);
  const std::size_t reach = html.find("reach on arm_left</th><td>it is out of reach</td><td>12</td>");
  const std::size_t aim = html.find("aim on head</th><td>there was not enough time for the speed of a joint</td><td>3</td>");
  EXPECT_LT(reach, aim);
  EXPECT_NE(aim, std::string::npos);
  EXPECT_TRUE(contains(html, check_title("balance") + "</th><td>the motion has no dynamics</td><td>2</td>"));
}

}  // namespace
}  // namespace contort
