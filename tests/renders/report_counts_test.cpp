// The failures that a report counts, and those that it counts separately.
#include <gtest/gtest.h>

#include "renders/report.h"

namespace contort {
namespace {

ReportModel model_with_states(const std::vector<std::string>& states) {
  ReportModel model;
  model.cases = 100;
  for (const std::string& state : states) {
    ReportRow& row = model.rows.emplace_back();
    row.check = "joint_range", row.subject = "human: " + state, row.family = "joint_range|human|" + state;
    row.bucket = row.key = "joint_range-" + state, row.character = "human", row.state = state;
    row.gating = state == "new" || state == "waiting";
  }
  return model;
}

TEST(ReportCounts, FailuresThatAreFixedOrWithoutASmallestCaseAreApart) {
  ReportModel model = model_with_states({"new", "open", "fixed", "waiting", "unconfirmed"});
  model.causes.resize(1);
  EXPECT_EQ(failures_text(model), "2 failures of 1 cause; 1 fixed; 1 waits to be shrunk; 1 seen only once");
  const std::string html = report_html(model);
  for (const char* item : {">failures</abbr></dt><dd>2</dd>", ">fixed</abbr></dt><dd>1</dd>",
                           ">waiting</abbr></dt><dd>1</dd>", ">unconfirmed</abbr></dt><dd>1</dd>"})
    EXPECT_NE(html.find(item), std::string::npos) << item;
  EXPECT_EQ(failures_text(model_with_states({"new"})), "1 failure of 0 causes");
}

TEST(ReportCounts, TheTitleCountsTheSameFailuresAsTheCounter) {
  EXPECT_EQ(gate_text(model_with_states({"open"})), "nothing fails the build");
  EXPECT_EQ(gate_text(model_with_states({"waiting"})), "1 failure that waits to be shrunk fails the build");
  const ReportModel model = model_with_states({"new", "new", "waiting", "waiting", "waiting"});
  const std::string html = report_html(model);
  for (const char* part : {"<h1>2 failures fail the build, 3 more wait to be shrunk</h1>",
                           ">failures</abbr></dt><dd>2</dd>", ">waiting</abbr></dt><dd>3</dd>", ": 2 new. "})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST(ReportCounts, FailuresOfAStoppedRunAreNamedAndTheReportIsNotGreen) {
  ReportModel model = model_with_states({"new"});
  model.unsettled = 15;
  const std::string sentence =
      "15 more failures of a stopped run are not shown: repeat its contort fuzz with --resume.";
  EXPECT_NE(report_html(model).find(sentence), std::string::npos);
  model.rows.clear();
  EXPECT_NE(report_html(model).find("<h1>The run was stopped before it was done</h1>"), std::string::npos);
  EXPECT_EQ(report_html(model).find("verdict good"), std::string::npos);
}

TEST(ReportCounts, ASpecThatWasNotShrunkIsNotCalledMinimal) {
  ReportModel model = model_with_states({"waiting"});
  model.rows[0].spec_json = "{}", model.rows[0].needs = "2 actions", model.rows[0].note = "not shrunk";
  const std::string html = report_html(model);
  for (const char* part : {"<summary>Spec as drawn (not shrunk yet)</summary>", "<dt>contains</dt>", "<dt>status</dt>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("Minimal spec"), std::string::npos);
}

}  // namespace
}  // namespace contort
