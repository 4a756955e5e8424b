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
  EXPECT_TRUE(holds(html, "By 1 cause. These do not fail the build: 1 open.")) << "the other cause does not gate";
  EXPECT_TRUE(holds(html, "<dt>of them clean</dt><dd>99.6 %</dd>"));
  EXPECT_TRUE(holds(html, ">causes</abbr></dt><dd>2</dd>"));
  EXPECT_TRUE(holds(html, ">failures</abbr></dt><dd>3</dd>"));
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
  EXPECT_TRUE(holds(html, "<td class='who'>human, mech</td>"));
  EXPECT_TRUE(holds(html, "<b>high</b> <span class='dim'>12.3 of 100</span>"));
}

TEST(CausesHtml, SayHowOftenAndWhetherTheyAreNew) {
  ReportModel model = model_with({elbow_cause(), elbow_cause()});
  model.cases = 6000, model.causes[0].news = CauseNews::fresh;
  const std::string html = causes_html(model, {});
  EXPECT_TRUE(holds(html, "<b>25 %</b> <span class='dim'>1\u202F500 of 6\u202F000 cases</span>"));
  EXPECT_TRUE(holds(html, "<span class='chip state-new'>new</span>"));
  EXPECT_TRUE(holds(html, "<span class='chip'>known</span>"));
  EXPECT_TRUE(holds(html, "causes</abbr> explain 4 failures; 1 is new. The most severe comes first."));
  model.has_baseline = true, model.causes[1].news = CauseNews::rare;
  EXPECT_TRUE(holds(causes_html(model, {}), "; 1 is new since the <abbr"));
  EXPECT_TRUE(holds(causes_html(model, {}), "<span class='chip'>rare</span>"));
  model.causes[1].news = CauseNews::more;
  EXPECT_TRUE(holds(causes_html(model, {}), "<span class='chip state-new'>more often</span>"));
}

// The row of the deepest case, with a film strip of eight tiles.
ReportModel model_with_strip() {
  ReportModel model = model_with({elbow_cause()});
  ReportRow row = row_in("a", true);
  row.key = "key-1", row.strip = "strips/key-1.png", row.subject = kMarkupInCause;
  row.first_frame = 11, row.worst_frame = 24, row.last_frame = 31, row.frame_count = 32;
  row.measured = row.sentence = "is at 120, limit 90", row.replay_command = "contort replay a";
  model.rows = {row, row_in("b", true)};
  return model;
}

TEST(CausesHtml, ShowTheWorstFrameAsAPieceOfTheStrip) {
  ReportModel model = model_with_strip();
  const std::string html = causes_html(model, {});
  // Frames 1, 10, 11, 17, 20, 24, 27 and 31 are on the strip: the worst one is in the sixth tile.
  EXPECT_TRUE(holds(html, "<a class='thumb tile-5' href='#case=key-1'><img src='strips/key-1.png' loading='lazy'"));
  const PageFiles inside = {{"cases/key-1.json", "{}"}, {"strips/key-1.png", "picture"}};
  EXPECT_TRUE(holds(causes_html(model, inside), "<img data-picture-of='key-1'")) << "the picture is on the card";
  EXPECT_FALSE(holds(causes_html(model, inside), "data:image"));
  model.rows[0].frame_count = 0;
  EXPECT_FALSE(holds(causes_html(model, {}), "<img")) << "the place of the worst frame is not known";
}

TEST(CausesHtml, UnfoldTheirFailuresAndTheCommand) {
  ReportModel model = model_with_strip();
  const std::string html = causes_html(model, {});
  EXPECT_TRUE(holds(html, "<span class='worst'>at worst is at 120, limit 90</span>"));
  EXPECT_TRUE(holds(html, "<details><summary>2 <abbr"));
  EXPECT_TRUE(holds(html, "<code>contort replay a</code>"));
  EXPECT_TRUE(holds(html, "<li><a href='#case=b'>"));
  EXPECT_FALSE(holds(html, "<script>"));
  model.causes[0].buckets.assign(14, "b");
  EXPECT_TRUE(holds(causes_html(model, {}), "4 more failures</li>"));
}

TEST(CausesHtml, LeadToTheCardWithoutScripts) {
  EXPECT_TRUE(holds(report_html(model_with_strip()), "<section class='bucket' id='case=key-1'"));
}

TEST(CausesHtml, NameTheirSeverity) {
  EXPECT_EQ(severity_word(100.0), "very high");
  EXPECT_EQ(severity_word(5.0), "high");
  EXPECT_EQ(severity_word(4.9), "medium");
  EXPECT_EQ(severity_word(0.2), "low");
}

TEST(CausesHtml, FoldAwayTheLessSevereOnes) {
  const std::string html = causes_html(model_with(std::vector<ReportCause>(12, elbow_cause())), {});
  EXPECT_TRUE(holds(html, "<details><summary>2 less severe causes</summary>\n<table class='causes'>"));
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
