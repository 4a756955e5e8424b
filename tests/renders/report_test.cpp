#include "renders/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "model/core/files.h"

namespace contort {
namespace {

constexpr char kMarkup[] = "\"><script>alert(1)</script>' onerror=alert(2) x='<!--";

ReportRow row_of(const std::string& check, const std::string& subject, const std::string& state, bool gating) {
  ReportRow row;
  row.family = check + "|" + subject;
  row.check = check;
  row.subject = subject;
  row.unit = "m";
  row.worst_margin = -0.0234;
  row.cases_seen = 1280;
  row.bucket = check + "-5f0c9a17";
  row.key = row.bucket, row.character = "human";
  row.state = state, row.gating = gating;
  row.spec_json = "{\n  \"character\": \"human\"\n}";
  row.replay_command = "contort replay corpus/" + row.bucket + "/min.json";
  row.strip = "strips/" + row.bucket + ".png";
  row.first_frame = 40, row.worst_frame = 55, row.last_frame = 80;
  row.needs = "reach";
  return row;
}

ReportModel page(std::vector<ReportRow> rows) {
  ReportModel model;
  model.title = "nightly";
  model.cases = 2048;
  model.rows = std::move(rows);
  return model;
}

std::size_t count(std::string_view text, std::string_view what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

bool contains(std::string_view text, std::string_view what) { return count(text, what) > 0; }

// The text that a browser would take for markup: the page without its two fixed blocks.
std::string body_of(const std::string& html) { return html.substr(html.find("<body>")); }

TEST(Report, NamesNewFailuresFirst) {
  const std::string html = report_html(page({row_of("joint_range", "a", "new", true)}));
  EXPECT_TRUE(contains(html, "<h1>1 new failure</h1>"));
  EXPECT_TRUE(contains(html, "class='verdict bad'"));
  EXPECT_TRUE(contains(html, "In 1 kind of failure"));
}

TEST(Report, SaysOfAFailureThatNoCaseShowedWhereItWasMet) {
  ReportRow row = row_of("c", "a", "new", true);
  EXPECT_FALSE(contains(report_html(page({row})), "no case of a recorded run showed it"));
  row.cases_seen = 0;
  EXPECT_TRUE(contains(report_html(page({row})), "<span>no case of a recorded run showed it</span>"));
}

TEST(Report, SaysHowFarTheSearchGot) {
  ReportModel model = page({});
  EXPECT_FALSE(contains(report_html(model), "How far the search got")) << "nothing ran";
  model.search.cases = 3000, model.search.arms = {{kMarkup, 3000, 0, 0}};
  EXPECT_TRUE(contains(report_html(model), "No case failed. With 95 % confidence, fewer than 1 in 1\u202F000 of"));
  EXPECT_FALSE(contains(body_of(report_html(model)), "<script>"));
  model.search.discovered = {10, 1500}, model.search.failing = 2;
  EXPECT_TRUE(contains(report_html(model), "so probably fewer than 1 in 1\u202F000 further cases"));
  model.search.met_once = 7, model.search.lone_cases = 2;
  const std::string html = report_html(model);
  EXPECT_TRUE(contains(html, "met after 1\u202F500 of 3\u202F000 cases"));
  EXPECT_TRUE(contains(html, "Estimate: one of 1\u202F500 further cases would show a new kind of failure."));
  EXPECT_FALSE(contains(html, "Guided"));
  model.search.arms = {{"guided", 5, 0, 0}};
  EXPECT_TRUE(contains(report_html(model), "Guided cases follow others"));
  model.search.cases = 20;
  EXPECT_TRUE(contains(report_html(model), "too few cases to say"));
  EXPECT_TRUE(contains(html, "d='M0.0 120.0L2.0 120.0L2.0 60.0L300.0 60.0L300.0 0.0L600.0 0.0'"));
}

TEST(Report, CountsWhatGatesByState) {
  const std::string html = report_html(
      page({row_of("c", "a", "new", true), row_of("c", "b", "regressed", true), row_of("c", "d", "open", false)}));
  EXPECT_TRUE(contains(html, "<h1>2 failures fail the build</h1>"));
  EXPECT_TRUE(contains(html, "In 2 kinds of failure: 1 new, 1 regressed. These do not fail the build: 1 open."));
}

TEST(Report, SaysWhenNothingGates) {
  const std::string html = report_html(page({row_of("c", "d", "open", false)}));
  EXPECT_TRUE(contains(html, "<h1>Nothing fails the build</h1>"));
  EXPECT_TRUE(contains(html, "class='verdict good'"));
}

TEST(Report, IsNotGreenWithoutWork) {
  const std::string html = report_html(ReportModel{});
  EXPECT_TRUE(contains(html, "<h1>Nothing was tested</h1>"));
  EXPECT_FALSE(contains(html, "verdict good"));
}

TEST(Report, ShowsEverythingOfARow) {
  ReportRow row = row_of("self_collision", "arm_left/forearm ~ torso/chest", "new", true);
  row.clip = "strips/moving.webp";
  const std::string html = report_html(page({row}));
  for (const char* wanted : {"self_collision</span>",
                             "arm_left/forearm ~ torso/chest</span>",
                             "-0.0234 m (-23.4 mm)",
                             "frame 55, 0.917 s",
                             "frames 40\u201380",
                             "1\u202F280 cases",
                             "reach",
                             "self_collision-5f0c9a17",
                             "<details>",
                             "Minimal spec",
                             "&quot;character&quot;: &quot;human&quot;",
                             "contort replay corpus/self_collision-5f0c9a17/min.json</code>",
                             "src='strips/self_collision-5f0c9a17.png'",
                             "href='strips/moving.webp'",
                             "data-case='self_collision-5f0c9a17'",
                             "class='open'>Look closer",
                             "data-character='human'",
                             "data-parts='arm_left torso'",
                             "loading='lazy'",
                             "alt='Film strip",
                             "data-missing='picture missing: contort replay",
                             "class='copy'"})
    EXPECT_TRUE(contains(html, wanted)) << wanted;
}

TEST(Report, NamesWhatComesWithAFailure) {
  ReportRow row = row_of("pop", "human: head/neck", "new", true);
  EXPECT_FALSE(contains(report_html(page({row})), ">comes with</abbr></dt><dd>pop"));
  row.co_failures = {{"pop", "human", "torso/lumbar_flex"}, {"self_collision", "human", "a/b ~ c/d"}};
  EXPECT_TRUE(contains(report_html(page({row})),
                       ">comes with</abbr></dt><dd>pop torso/lumbar_flex, self_collision a/b ~ c/d</dd>"));
  row.co_failures.clear();
  for (int i = 1; i <= 7; ++i) row.co_failures.push_back({"a", "h", std::to_string(i)});
  EXPECT_TRUE(contains(report_html(page({row})), "<dd>a 1, a 2, a 3, a 4, a 5, and 2 more</dd>"));
  row.co_failures = {{kMarkup, "human", "one"}, {"one", "human", kMarkup}};
  EXPECT_FALSE(contains(body_of(report_html(page({row}))), kMarkup));
}

TEST(Report, SaysWhereAPictureIsMissing) {
  ReportRow row = row_of("c", "a", "new", true);
  for (const char* none : {"", "../outside.png"}) {
    row.strip = none;
    const std::string html = report_html(page({row}));
    EXPECT_FALSE(contains(html, "<img"));
    EXPECT_TRUE(contains(html, "picture missing: contort replay"));
  }
}

TEST(Report, HasOneCardForAFamilyAndGatingOnesFirst) {
  std::vector<ReportRow> rows = {row_of("c", "known", "open", false), row_of("c", "both", "open", false),
                                 row_of("c", "known", "open", false), row_of("c", "both", "new", true)};
  rows[3].cases_seen = 2000;
  const std::string html = report_html(page(rows));
  EXPECT_EQ(count(html, "<article"), 2u);
  EXPECT_EQ(count(html, "<section class='bucket'"), 4u);
  EXPECT_EQ(count(html, "1 more failure</summary>"), 2u);
  EXPECT_EQ(count(html, "1\u202F280 cases, 2 failures"), 1u);
  EXPECT_EQ(count(html, "2\u202F000 cases, 2 failures"), 1u);  // cases of the family, not the sum
  EXPECT_LT(html.find("both</span>"), html.find("known</span>"));
}

// Names as long as those of real parts, without pictures.
ReportModel large_model(int count, int family_size = 1) {
  std::vector<ReportRow> rows;
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    const std::string family = std::to_string(i / family_size);
    ReportRow row = row_of("self_collision", "human: arm_left/forearm_" + family + " ~ torso/chest", "new", true);
    row.key = row.bucket = "self_collision-0123456789" + number;
    row.replay_command = "contort replay contort-out/corpus/buckets/" + row.key + "/min-0123456789abcdef.json";
    row.needs = "pose + reach + walk, 2 clips, a swapped part", row.phase = "interrupt";
    row.clip = "strips/" + row.key + "-01234567.webp";
    row.spec_json = std::string(11'000, 'x');  // the size of a failure that was not shrunk
    rows.push_back(std::move(row));
  }
  return page(std::move(rows));
}

nlohmann::json rows_of(const std::string& script) {
  EXPECT_TRUE(script.starts_with("contortRows(") && script.ends_with(");\n"));
  return nlohmann::json::parse(script.substr(12, script.size() - 15));
}

// Returns true if page.js finds a place for each bucket: in a card that begins with it, or in one that has a list for
// more.
bool have_places(const PageFiles& pages) {
  std::set<int> lists;
  for (int part = 1; pages.contains("rows/part-" + std::to_string(part) + ".js"); ++part)
    for (const auto& card : rows_of(pages.at("rows/part-" + std::to_string(part) + ".js"))) {
      const int number = card["card"];
      const bool on_page =
          pages.at("index.html").find("data-more='" + std::to_string(number) + "'") != std::string::npos;
      if (card["buckets"].empty() || (!card.contains("check") && !on_page && !lists.contains(number))) return false;
      if (card.contains("more")) lists.insert(number);
    }
  return true;
}

// All keys of the page, then of the files that it loads.
std::vector<std::string> keys_of(const PageFiles& pages) {
  std::vector<std::string> keys;
  const std::string& html = pages.at("index.html");
  for (std::size_t at = html.find("data-case='"); at != html.npos; at = html.find("data-case='", at + 1))
    keys.push_back(html.substr(at + 11, html.find('\'', at + 11) - at - 11));
  for (int part = 1; pages.contains("rows/part-" + std::to_string(part) + ".js"); ++part)
    for (const auto& card : rows_of(pages.at("rows/part-" + std::to_string(part) + ".js")))
      for (const auto& bucket : card["buckets"]) keys.push_back(bucket["key"]);
  return keys;
}

TEST(Report, APageIsBelowAMegabyteAndHasEachBucketOnce) {
  for (const int count : {1000, 3000})
    for (const int family_size : {1, 7, count}) {
      const ReportModel model = large_model(count, family_size);
      const PageFiles pages = report_pages(model);
      EXPECT_LT(pages.at("index.html").size(), 1'000'000u);
      std::vector<std::string> keys = keys_of(pages), wanted;
      for (const ReportRow& row : model.rows) wanted.push_back(row.key);
      std::sort(keys.begin(), keys.end()), std::sort(wanted.begin(), wanted.end());
      EXPECT_TRUE(have_places(pages)) << count << " buckets, " << family_size << " of each family";
      EXPECT_EQ(keys, wanted) << count << " buckets, " << family_size << " of each family";
    }
}

// Without scripts, index.html and the list of the others that it links have all buckets.
TEST(Report, WhoHasNoScriptsFindsEachBucketToo) {
  const PageFiles pages = report_pages(large_model(3000));
  const std::string& html = pages.at("index.html");
  const std::size_t here = count(html, "<article");
  EXPECT_GT(here, 300u);
  EXPECT_TRUE(contains(html, "<a href='more.html'>"));
  EXPECT_EQ(count(pages.at("more.html"), "<tr><td>"), 3000u - here);
  EXPECT_EQ(count(pages.at("more.html"), "<code>contort replay "), 3000u - here);
  EXPECT_FALSE(contains(pages.at("more.html"), "<script"));
}

TEST(Report, AFamilyThatIsTooLargeGoesOnInTheFilesBesideThePage) {
  const PageFiles pages = report_pages(large_model(3000, 3000));
  const std::string& html = pages.at("index.html");
  EXPECT_EQ(count(html, "<article"), 1u);
  EXPECT_TRUE(contains(html, "<details data-more='0'><summary>2\u202F999 more failures"));
  const auto cards = rows_of(pages.at("rows/part-1.js"));
  EXPECT_EQ(cards.size(), 1u);
  EXPECT_FALSE(cards[0].contains("check")) << "the card is there already";
  EXPECT_EQ(cards[0]["card"], 0);
}

TEST(Report, ASmallOneIsOnePage) {
  EXPECT_EQ(report_pages(large_model(200)).size(), 1u);
  const std::string html = report_html(large_model(3000), {{"viewer/viewer.css", "x"}});
  EXPECT_EQ(count(html, "<article"), 3000u) << "a file for mail has nothing beside it";
}

TEST(Report, TellsThePhase) {
  ReportRow row = row_of("c", "a", "new", true);
  row.phase = "interrupt";
  ReportRow other = row;
  other.phase = "mid_clip", other.key = "c-0";
  const std::string html = report_html(page({row, other}));
  EXPECT_TRUE(contains(html, "data-phase='interrupt mid_clip'"));
  EXPECT_TRUE(contains(html, "<dd>interrupt: just after an interrupt</dd>"));
  EXPECT_TRUE(contains(html, "<select id='phase'>"));
  row.phase = "";
  EXPECT_FALSE(contains(report_html(page({row})), ">phase</abbr></dt><dd>interrupt"));
}

ReportModel hostile_model() {
  ReportRow row;
  for (std::string* text :
       {&row.family, &row.check, &row.subject, &row.unit, &row.bucket, &row.state, &row.spec_json, &row.replay_command,
        &row.strip, &row.clip, &row.features, &row.key, &row.character, &row.meaning, &row.phase})
    *text = kMarkup;
  row.worst_margin = std::nan("");
  row.rate_hz = std::nan("");
  ReportModel model = page({row, row});
  model.title = model.elapsed = kMarkup;
  model.tested = {{kMarkup, 1}, {"\xff\xfe\x01", -5}};
  return model;
}

TEST(Report, EscapesEveryText) {
  const std::string html = report_html(hostile_model()), body = body_of(html);
  EXPECT_FALSE(contains(body, "<script"));
  EXPECT_FALSE(contains(body, "<!--"));
  EXPECT_FALSE(contains(body, "\""));  // our own attributes have single quotes: any double one is not ours
  EXPECT_FALSE(contains(body, "' onerror"));
  EXPECT_EQ(count(html, "<script"), 1u);
  EXPECT_EQ(count(html, "</script"), 1u);
  EXPECT_EQ(count(html, "<title>"), 1u);
}

TEST(Report, KeepsAScriptEndInASpecAsText) {
  ReportRow row = row_of("c", "a", "new", true);
  row.spec_json = "{\"name\": \"</script><script>alert(3)</script>\"}";
  const std::string html = report_html(page({row}));
  EXPECT_TRUE(contains(html, "&lt;/script&gt;&lt;script&gt;alert(3)"));
  EXPECT_EQ(count(html, "</script"), 1u);
}

TEST(Report, AllowsNoScriptButItsOwnAndNoNetwork) {
  const std::string html = report_html(hostile_model());
  EXPECT_TRUE(contains(html, "default-src 'none'"));
  EXPECT_TRUE(contains(html, "script-src 'nonce-"));
  EXPECT_FALSE(contains(html, "unsafe-inline"));
  EXPECT_FALSE(contains(html, "http:"));
  EXPECT_FALSE(contains(html, "https:"));
  EXPECT_FALSE(contains(body_of(html), " style="));
}

TEST(Report, AllowsWebAssemblyOnlyWhereItHasTheEngine) {
  ReportModel model = hostile_model();
  EXPECT_FALSE(contains(report_html(model), "wasm-unsafe-eval"));
  model.has_engine = true;
  EXPECT_TRUE(contains(report_html(model), "' 'wasm-unsafe-eval'; base-uri"));
  EXPECT_TRUE(contains(report_html(model), "<html lang='en' data-engine>"));
}

TEST(Report, IsTheSameForTheSameModel) { EXPECT_EQ(report_html(hostile_model()), report_html(hostile_model())); }

TEST(ReportJson, HoldsTheModel) {
  ReportModel model = page({row_of("c", "a", "new", true)});
  model.tested = {{"action walk", 7}};
  const auto json = nlohmann::json::parse(report_json(model));
  EXPECT_EQ(json["format"], "contort.report/1");
  EXPECT_EQ(json["cases"], 2048);
  EXPECT_EQ(json["rows"][0]["worst_margin"], -0.0234);
  EXPECT_EQ(json["rows"][0]["gating"], true);
  EXPECT_EQ(json["rows"][0]["spec"]["character"], "human");  // a tree, not a text
  EXPECT_EQ(json["tested"][0]["name"], "action walk");
  EXPECT_EQ(json["tested"][0]["count"], 7);
}

TEST(ReportJson, IsJsonForAnyText) {
  const auto json = nlohmann::json::parse(report_json(hostile_model()));
  EXPECT_TRUE(json["rows"][0]["worst_margin"].is_null());
  EXPECT_EQ(json["rows"][0]["spec"], kMarkup);
}

TEST(WriteReport, WritesBothFilesAndNothingElse) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "contort_report" / "deep";
  std::filesystem::remove_all(folder);
  const ReportModel model = page({row_of("c", "a", "new", true)});
  for (int again = 0; again < 2; ++again) ASSERT_TRUE(write_report(model, folder.string()).ok());
  EXPECT_EQ(read_file((folder / "index.html").string()).value(), report_html(model));
  EXPECT_EQ(read_file((folder / "report.json").string()).value(), report_json(model));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 2);
  std::filesystem::remove_all(folder.parent_path());
}

TEST(WriteReport, RemovesWhatALargerReportHadBesides) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "contort_report_rest";
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(write_report(large_model(2500), folder.string()).ok());
  EXPECT_TRUE(std::filesystem::exists(folder / "rows" / "part-2.js"));
  EXPECT_TRUE(std::filesystem::exists(folder / "more.html"));
  std::ofstream(folder / "rows" / "part-theirs.js") << "theirs";
  ASSERT_TRUE(write_report(large_model(10), folder.string()).ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "rows" / "part-1.js"));
  EXPECT_FALSE(std::filesystem::exists(folder / "more.html"));
  std::ofstream(folder / "more.html") << "theirs";
  ASSERT_TRUE(write_report(large_model(10), folder.string()).ok());
  EXPECT_TRUE(std::filesystem::exists(folder / "more.html"));
  EXPECT_TRUE(std::filesystem::exists(folder / "rows" / "part-theirs.js"));
  std::filesystem::remove_all(folder);
}

TEST(Report, TheRestIsEscapedToo) {
  std::vector<ReportRow> rows = large_model(1500).rows;
  rows.push_back(hostile_model().rows.front());
  rows.back().gating = true;
  const ReportModel model = page(rows);
  const PageFiles pages = report_pages(model);
  EXPECT_FALSE(contains(pages.at("more.html"), "<script"));
  EXPECT_FALSE(contains(pages.at("more.html"), "' onerror"));
  EXPECT_EQ(rows_of(pages.at("rows/part-2.js")).back()["subject"], kMarkup);
}

TEST(WriteReport, RefusesAFolderThatCannotBe) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "contort_report_file";
  std::ofstream(file) << "x";
  const Result<Done> written = write_report(ReportModel{}, (file / "below").string());
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.issue().code, "file.unwritable");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace contort
