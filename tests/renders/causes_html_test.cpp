// The table of causes at the top of a report.
#include "renders/causes_html.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace contort {
namespace {

constexpr char kMarkupInCause[] = "\"><script>alert(1)</script>' onerror=alert(2) x='<!--";

ReportCause elbow_cause() {
  return {"0123456789ab", "Left elbow leaves its range during aim", 12.34, 1500, {"human", "mech"}, {"a", "b"},
          "key-1"};
}

ReportModel model_with(std::vector<ReportCause> causes) {
  ReportModel model;
  model.title = "nightly";
  model.causes = std::move(causes);
  return model;
}

bool holds(const std::string& text, const std::string& what) { return text.find(what) != text.npos; }

TEST(CausesHtml, WithoutCausesHaveNoSection) { EXPECT_EQ(causes_html(model_with({}), {}), ""); }

TEST(CausesHtml, ComeBeforeTheFailures) {
  const std::string html = report_html(model_with({elbow_cause()}));
  ASSERT_TRUE(holds(html, "<section id='causes'>"));
  EXPECT_LT(html.find("<section id='causes'>"), html.find("<section id='failures'>"));
}

// A row of its own check, with the id of that check.
ReportRow row_in(const std::string& bucket, bool gating) {
  ReportRow row;
  row.family = row.check = row.bucket = row.key = bucket;
  row.state = gating ? "new" : "open", row.gating = gating;
  return row;
}

TEST(CausesHtml, AreCountedInTheHeadWithTheShareOfCleanCases) {
  ReportModel model = model_with({elbow_cause(), elbow_cause()});
  model.rows = {row_in("a", true), row_in("b", true), row_in("c", false)};
  model.causes[1].buckets = {"c"};
  model.search.cases = 300, model.search.failing = 1;
  const std::string html = report_html(model);
  EXPECT_TRUE(holds(html, "<h1>2 new failures</h1>"));
  EXPECT_TRUE(holds(html, "By 1 cause. Known, not gating: 1 open.")) << "the other cause does not gate";
  EXPECT_TRUE(holds(html, "<dt>of them clean</dt><dd>99.6 %</dd>"));
  EXPECT_TRUE(holds(html, "<dt>causes</dt><dd>2</dd>"));
  EXPECT_TRUE(holds(html, "<dt>failures</dt><dd>3</dd>"));
  model.search.failing = 0;
  EXPECT_TRUE(holds(report_html(model), "<dt>of them clean</dt><dd>100 %</dd>"));
}

TEST(CausesHtml, SayWhenTheyFailInTextThatIsEscaped) {
  ReportCause cause = elbow_cause();
  cause.conditions = {{"human", "Fails where a < 1."}, {"mech", kMarkupInCause}};
  const std::string html = causes_html(model_with({cause}), {});
  EXPECT_TRUE(holds(html, "<p class='when'>human: Fails where a &lt; 1.</p>"));
  EXPECT_FALSE(holds(html, "<script>"));
}

TEST(CausesHtml, OpenTheirDeepestCase) {
  const std::string html = causes_html(model_with({elbow_cause()}), {});
  EXPECT_TRUE(holds(html, "<a href='#case=key-1'>Left elbow leaves its range during aim</a>"));
  EXPECT_TRUE(holds(html, "<td>human, mech</td><td>1\u202F500</td><td>2</td><td>12.3</td>"));
}

TEST(CausesHtml, HaveNoLinkWithoutAMotion) {
  ReportCause crash = elbow_cause();
  crash.key = "";
  EXPECT_FALSE(holds(causes_html(model_with({crash}), {}), "href"));
  const PageFiles inside = {{"cases/another.json", "{}"}};
  EXPECT_FALSE(holds(causes_html(model_with({elbow_cause()}), inside), "href")) << "this page has no such case";
}

TEST(CausesHtml, AreTextAndNeverMarkup) {
  const std::string html =
      causes_html(model_with({{"ba9876543210", kMarkupInCause, 1.0, 1, {kMarkupInCause}, {"c"}, kMarkupInCause}}), {});
  EXPECT_FALSE(holds(html, "<script>"));
  EXPECT_FALSE(holds(html, "x='<!--"));
}

TEST(CausesHtml, SayHowManyMoreThereAre) {
  EXPECT_TRUE(holds(causes_html(model_with(std::vector<ReportCause>(45, elbow_cause())), {}),
                    "15 more causes in report.json"));
}

TEST(CausesHtml, StandInTheJsonToo) {
  const auto json = nlohmann::json::parse(report_json(model_with({elbow_cause()})));
  EXPECT_EQ(json["causes"][0]["headline"], "Left elbow leaves its range during aim");
  EXPECT_EQ(json["causes"][0]["buckets"].size(), 2U);
}

}  // namespace
}  // namespace contort
