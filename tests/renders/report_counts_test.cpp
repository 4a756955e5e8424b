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

}  // namespace
}  // namespace contort
