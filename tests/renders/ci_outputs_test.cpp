// The files for build servers, read back: JUnit with an XML parser, SARIF by GitHub's requirements.
#include "renders/ci_outputs.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace contort {
namespace {

using Json = nlohmann::json;

// Text with the ends of attributes, cells, fences, commands and lines of all outputs, and with bytes that XML cannot
// contain.
constexpr char kHostile[] = "\"'><b>]]>&amp;|`` :: ,%0A\n::error::x\r\x01\x1b[31m\xff\xef\xbf\xbf <!-- $(x) [a](b) \\";

ReportRow row_of(const std::string& state, bool gating, int number = 0) {
  ReportRow row;
  row.family = "joint_range|human|arm_left/elbow max";
  row.check = "joint_range";
  row.subject = "human: arm_left/elbow max";
  row.unit = "rad";
  row.worst_margin = -0.21;
  row.bucket = std::to_string(100000000000 + number);
  row.state = state;
  row.gating = gating;
  row.worst_frame = 12;
  row.case_file = "corpus/buckets/joint_range-" + row.bucket + "/min-0123456789abcdef.json";
  row.replay_command = "contort replay " + row.case_file;
  return row;
}

ReportModel model_of(std::vector<ReportRow> rows) {
  ReportModel model;
  model.title = "Contort report";
  model.tool = "0.1.0";
  model.rows = std::move(rows);
  return model;
}

ReportModel all_states() {
  ReportModel model = model_of({row_of("open", false, 1), row_of("new", true, 2), row_of("fixed", false, 3),
                                row_of("regressed", true, 4), row_of("quarantined", false, 5),
                                row_of("quarantined", true, 6), row_of("flaky", false, 7)});
  model.rows[4].note = "ana, until 2027-03-01: soft stop";
  return model;
}

ReportRow hostile_row(const std::string& text) {
  ReportRow row = row_of("new", true);
  for (std::string ReportRow::*field :
       {&ReportRow::family, &ReportRow::check, &ReportRow::subject, &ReportRow::unit, &ReportRow::bucket,
        &ReportRow::state, &ReportRow::case_file, &ReportRow::replay_command, &ReportRow::note})
    row.*field = text;
  return row;
}

// ---- JUnit

struct Parsed {
  tinyxml2::XMLDocument document;
  std::vector<const tinyxml2::XMLElement*> cases;
  explicit Parsed(const std::string& xml) {
    EXPECT_EQ(document.Parse(xml.c_str(), xml.size()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
    const tinyxml2::XMLElement* suites = document.FirstChildElement("testsuites");
    for (auto* suite = suites != nullptr ? suites->FirstChildElement("testsuite") : nullptr; suite != nullptr;
         suite = suite->NextSiblingElement("testsuite"))
      for (auto* test = suite->FirstChildElement("testcase"); test != nullptr;
           test = test->NextSiblingElement("testcase"))
        cases.push_back(test);
  }
  const tinyxml2::XMLElement* case_of(const std::string& bucket) const {
    for (const tinyxml2::XMLElement* test : cases)
      if (std::string(test->Attribute("name")).starts_with(bucket)) return test;
    return nullptr;
  }
};

TEST(Junit, ATestCaseForEachBucketFailsWhereItGatesAndOnlyThere) {
  const ReportModel model = all_states();
  const Parsed parsed(junit_xml(model));
  ASSERT_EQ(parsed.cases.size(), model.rows.size());
  for (const ReportRow& row : model.rows) {
    SCOPED_TRACE(row.state);
    const tinyxml2::XMLElement* test = parsed.case_of(row.bucket);
    ASSERT_NE(test, nullptr);
    EXPECT_EQ(test->FirstChildElement("failure") != nullptr, row.gating);
    EXPECT_EQ(test->FirstChildElement("skipped") != nullptr, !row.gating && row.state != "fixed");
    const bool regression = row.state == "fixed" || row.state == "regressed";
    EXPECT_STREQ(test->Parent()->ToElement()->Attribute("name"), regression ? "regressions" : "buckets");
  }
}

TEST(Junit, CountsAreThoseOfTheCases) {
  const Parsed parsed(junit_xml(all_states()));
  const tinyxml2::XMLElement* suites = parsed.document.FirstChildElement("testsuites");
  EXPECT_EQ(suites->IntAttribute("tests"), 7);
  EXPECT_EQ(suites->IntAttribute("failures"), 3);
  EXPECT_EQ(suites->IntAttribute("skipped"), 3);
}

TEST(Junit, AFailureSaysWhatFailedHowDeepAndHowToSeeIt) {
  const Parsed parsed(junit_xml(model_of({row_of("new", true)})));
  ASSERT_EQ(parsed.cases.size(), 1U);
  EXPECT_STREQ(parsed.cases[0]->Attribute("classname"), "contort.joint_range");
  const std::string text = parsed.cases[0]->FirstChildElement("failure")->GetText();
  for (const char* part : {"joint_range|human|arm_left/elbow max", "-0.21 rad", "contort replay corpus/buckets"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Junit, TextsThatAreMarkupComeBackAsText) {
  ReportRow row = row_of("new", true);
  row.subject = "\"<arm>\" & 'hand' ]]> &amp;";
  const Parsed parsed(junit_xml(model_of({row})));
  ASSERT_EQ(parsed.cases.size(), 1U);
  EXPECT_EQ(parsed.cases[0]->Attribute("name"), row.bucket + " " + row.subject);
}

bool is_xml_character(unsigned char c) { return c >= 0x20 || c == '\n' || c == '\t' || c == '\r'; }

void expect_xml_characters(const std::string& xml) {
  EXPECT_TRUE(std::ranges::all_of(xml, [](char c) { return is_xml_character(static_cast<unsigned char>(c)); }));
  EXPECT_EQ(xml.find("\xEF\xBF\xBF"), std::string::npos) << "U+FFFF is no character of XML";
  EXPECT_EQ(xml.find("\xEF\xBF\xBE"), std::string::npos) << "U+FFFE is no character of XML";
  EXPECT_NO_THROW(Json(xml).dump()) << "no UTF-8";
}

TEST(Junit, ControlCharactersAndBrokenTextAreReplaced) {
  ReportModel model = model_of({hostile_row(kHostile), hostile_row("\xEF\xBF\xBE\xEF\xBF\xBF\x7f\xc3")});
  model.title = kHostile;
  const std::string xml = junit_xml(model);
  EXPECT_EQ(Parsed(xml).cases.size(), 2U);
  expect_xml_characters(xml);
}

// ---- SARIF

Json sarif_of(const ReportModel& model) {
  const Json log = Json::parse(sarif_json(model), nullptr, false);
  EXPECT_TRUE(log.is_object());
  return log;
}

// https://docs.github.com/en/code-security/code-scanning/integrating-with-code-scanning/sarif-support-for-code-scanning
TEST(CiOutputs, SayWhatTheBaseOfAComparisonShows) {
  ReportRow row = row_of("new", true);
  EXPECT_EQ(junit_xml(model_of({row})).find("the base"), std::string::npos);
  row.since_base = "new since the base; the base passes this case by 0.84";
  EXPECT_NE(junit_xml(model_of({row})).find("0.84\ncontort replay"), std::string::npos);
  const Json result = sarif_of(model_of({row}))["runs"][0]["results"][0];
  EXPECT_NE(result["message"]["text"].get<std::string>().find(", " + row.since_base + ". contort replay"),
            std::string::npos);
  EXPECT_NE(report_html(model_of({row})).find(">in the base</abbr></dt><dd>" + row.since_base + "</dd>"), std::string::npos);
}

TEST(Sarif, HasTheFieldsThatGithubNeeds) {
  const Json log = sarif_of(all_states());
  EXPECT_EQ(log["version"], "2.1.0");
  EXPECT_TRUE(log["$schema"].get<std::string>().ends_with("sarif-2.1.0.json"));
  ASSERT_EQ(log["runs"].size(), 1U);
  const Json& driver = log["runs"][0]["tool"]["driver"];
  EXPECT_EQ(driver["name"], "Contort");
  EXPECT_EQ(driver["version"], "0.1.0");
  for (const Json& rule : driver["rules"])
    for (const char* field : {"shortDescription", "fullDescription", "help"})
      EXPECT_FALSE(rule[field]["text"].get<std::string>().empty()) << field;
  for (const Json& result : log["runs"][0]["results"]) {
    EXPECT_EQ(driver["rules"][result["ruleIndex"].get<std::size_t>()]["id"], result["ruleId"]);
    EXPECT_FALSE(result["message"]["text"].get<std::string>().empty());
    const Json& place = result["locations"][0]["physicalLocation"];
    EXPECT_TRUE(place["artifactLocation"]["uri"].get<std::string>().starts_with("corpus/buckets/"));
    EXPECT_EQ(place["region"]["startLine"], 1);
    EXPECT_EQ(result["partialFingerprints"]["contort/v1"].get<std::string>() + ":1",
              result["partialFingerprints"]["primaryLocationLineHash"]);
  }
}

TEST(Sarif, ErrorsGateAndWhatIsFixedIsNoResult) {
  const Json log = sarif_of(all_states());
  const Json& results = log["runs"][0]["results"];
  EXPECT_EQ(results.size(), 6U);
  for (std::size_t i = 0; i < results.size(); ++i) EXPECT_EQ(results[i]["level"], i < 3 ? "error" : "note");
  const auto hidden = std::ranges::find_if(results, [](const Json& r) { return r.contains("suppressions"); });
  ASSERT_NE(hidden, results.end());
  EXPECT_EQ((*hidden)["suppressions"][0]["justification"], "ana, until 2027-03-01: soft stop");
}

TEST(Sarif, AfterFiveThousandResultsTheRestIsANote) {
  std::vector<ReportRow> rows;
  for (int i = 0; i < 5003; ++i) rows.push_back(row_of("open", false, i));
  rows.push_back(row_of("new", true, 5003));
  const Json log = sarif_of(model_of(rows));
  const Json& run = log["runs"][0];
  EXPECT_EQ(run["results"].size(), kMostSarifResults);
  EXPECT_EQ(run["results"][0]["level"], "error") << "what gates is never what is left out";
  EXPECT_EQ(run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"], "4 more results are left out");
}

TEST(Sarif, HostileTextsStayTexts) {
  const Json log = sarif_of(model_of({hostile_row(kHostile)}));
  const std::string uri = log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"];
  EXPECT_EQ(uri.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.~/%"),
            std::string::npos)
      << uri;
}

// ---- annotations

TEST(Annotations, OneForEachFailureThatGates) {
  const std::vector<std::string> lines = github_annotations(all_states());
  ASSERT_EQ(lines.size(), 3U);
  for (const std::string& line : lines) EXPECT_TRUE(line.starts_with("::error file=corpus/buckets/")) << line;
  EXPECT_TRUE(github_annotations(model_of({row_of("open", false)})).empty());
}

TEST(Annotations, TenAndThenACount) {
  std::vector<ReportRow> rows;
  for (int i = 0; i < 10; ++i) rows.push_back(row_of("new", true, i));
  EXPECT_EQ(github_annotations(model_of(rows)).size(), 10U);
  for (int i = 0; i < 7; ++i) rows.push_back(row_of("regressed", true, 10 + i));
  const std::vector<std::string> lines = github_annotations(model_of(rows));
  ASSERT_EQ(lines.size(), 11U);
  EXPECT_EQ(lines.back(), "::notice::7 more");
}

TEST(Annotations, AHostileNameStartsNoCommandAndNoProperty) {
  ReportRow row = row_of("new", true);
  row.case_file = "a,line=3::b%0A\n::error::c";
  row.family = "x%0A\n::error::y";
  const std::vector<std::string> lines = github_annotations(model_of({row}));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].find('\n'), std::string::npos);
  EXPECT_TRUE(lines[0].starts_with("::error file=a%2Cline=3%3A%3Ab%250A")) << lines[0];
  EXPECT_NE(lines[0].find("x%250A"), std::string::npos) << lines[0];
}

// ---- Markdown

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

TEST(Markdown, TheVerdictComesFirst) {
  EXPECT_TRUE(markdown_summary(all_states()).starts_with("## Contort report: 3 failures fail the build\n"));
  EXPECT_TRUE(markdown_summary(model_of({row_of("new", true)})).starts_with("## Contort report: 1 failure fails the build\n"));
  const std::string clean = markdown_summary(model_of({row_of("open", false), row_of("open", false)}));
  EXPECT_TRUE(clean.starts_with("## Contort report: nothing fails the build\n")) << clean;
  EXPECT_NE(clean.find("Known: 2 open."), std::string::npos) << clean;
  EXPECT_EQ(count(clean, "|"), 0U) << "no table without failures";
}

TEST(Markdown, TheTableHasWhatGatesAndNoMoreThanAPageHolds) {
  EXPECT_EQ(count(markdown_summary(all_states()), "<code>contort replay "), 3U);
  std::vector<ReportRow> rows;
  for (int i = 0; i < 130; ++i) rows.push_back(row_of("new", true, i));
  const std::string long_one = markdown_summary(model_of(rows));
  EXPECT_EQ(count(long_one, "<code>contort replay "), kMostMarkdownRows);
  EXPECT_TRUE(long_one.ends_with("\n30 more\n"));
}

// Counts cells as a reader of tables does: a backslash escapes the next character, and every other bar ends a cell.
int cells_of(const std::string& line) {
  int bars = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\')
      ++i;
    else
      bars += line[i] == '|' ? 1 : 0;
  }
  return bars - 1;
}

TEST(Markdown, AHostileNameMakesNoCellNoLineAndNoMarkup) {
  ReportRow row = hostile_row(kHostile);
  row.replay_command = "contort replay 'a\\|b\\\\|`c'";
  const std::string text = markdown_summary(model_of({row}));
  const std::string line = text.substr(text.rfind("\n| ") + 1);
  EXPECT_EQ(count(line, "\n"), 1U);
  EXPECT_EQ(cells_of(line), 5) << line;
  EXPECT_NE(line.find("\\<b\\>"), std::string::npos) << line;
  EXPECT_EQ(count(line, "<"), count(line, "\\<") + 2) << "only <code> and its end are markup: " << line;
}

RC_GTEST_PROP(CiOutputs, AnyBytesGiveOutputsThatCanBeRead, (const std::string& bytes)) {
  const ReportModel model = model_of({hostile_row(bytes), hostile_row(bytes + kHostile + bytes)});
  const std::string xml = junit_xml(model);
  tinyxml2::XMLDocument document;
  RC_ASSERT(document.Parse(xml.c_str(), xml.size()) == tinyxml2::XML_SUCCESS);
  RC_ASSERT(!Json::parse(sarif_json(model), nullptr, false).is_discarded());
  for (const std::string& line : github_annotations(model)) RC_ASSERT(line.find_first_of("\r\n") == std::string::npos);
  RC_ASSERT(count(markdown_summary(model), "\n") == 8U);
}

}  // namespace
}  // namespace contort
