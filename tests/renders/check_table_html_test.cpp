#include "renders/check_table_html.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

ReportRow failure_of(const std::string& check, const std::string& character, const std::string& state = "new") {
  ReportRow row;
  row.check = check, row.character = character, row.state = state;
  return row;
}

bool shows_text(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

TEST(CheckTable, OfNoFailuresThereIsNone) {
  EXPECT_EQ(check_table_html({}), "");
  ReportModel model;
  model.rows = {failure_of("pop", "human", "fixed")};
  EXPECT_EQ(check_table_html(model), "");
}

TEST(CheckTable, CountsFailuresByCheckAndCharacter) {
  ReportModel model;
  model.tested = {{"character human", 1200}};
  model.rows = {failure_of("pop", "mech"), failure_of("self_collision", "human"), failure_of("self_collision", "human"),
                failure_of("self_collision", "mech"), failure_of("pop", "human", "fixed")};
  const std::string html = check_table_html(model);
  EXPECT_TRUE(shows_text(html, "<th scope='col'>human<span class='dim'>1\u202F200 cases</span></th>"));
  EXPECT_TRUE(shows_text(html, "<th scope='col'>mech</th>"));
  EXPECT_LT(html.find("Goes through itself <span class='dim'>self_collision</span>"), html.find("Sudden jump"));
  EXPECT_TRUE(shows_text(html, "<td class='zero'>0</td>")) << "no jump of the human";
  EXPECT_TRUE(shows_text(html, "<td>2<svg class='bar'"));
  EXPECT_TRUE(shows_text(html, "width='50.00'"));
  EXPECT_TRUE(shows_text(html, "<td>3</td></tr>")) << "of all characters";
}

TEST(CheckTable, IsTextAndNeverMarkup) {
  ReportModel model;
  model.rows = {failure_of("<script>", "<script>")};
  EXPECT_FALSE(shows_text(check_table_html(model), "<script>"));
}

TEST(CheckTable, StandsBetweenCausesAndFailures) {
  ReportModel model;
  model.rows = {failure_of("pop", "human")};
  model.causes.resize(1);
  const std::string html = report_html(model);
  EXPECT_LT(html.find("<section id='causes'>"), html.find("<section id='checks'>"));
  EXPECT_LT(html.find("<section id='checks'>"), html.find("<section id='failures'"));
}

}  // namespace
}  // namespace contort
