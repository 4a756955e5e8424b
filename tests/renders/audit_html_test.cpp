// The page of an audit: its order, its verdict, and text that cannot break out of it.
#include "renders/audit_html.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

AuditPageRow row(const std::string& character, const std::string& action, int clean, int unmet) {
  return {character, "arm_left", action, 1000, clean, unmet, 0, "pop 3", "", ""};
}

std::size_t place_of(const std::string& html, const std::string& text) {
  const std::size_t at = html.find(text);
  EXPECT_NE(at, std::string::npos) << text;
  return at;
}

TEST(AuditPage, ShowsTheWorstRowsOfACharacterFirst) {
  const std::string html = audit_html(
      {"contort audit", "0.1.0",
       {row("mech", "fine", 1000, 0), row("human", "asks_much", 1000, 500), row("mech", "bad", 100, 0), row("human", "worst", 10, 0)}});
  EXPECT_LT(place_of(html, ">bad<"), place_of(html, ">fine<"));
  EXPECT_LT(place_of(html, ">fine<"), place_of(html, ">worst<")) << "characters stand in the order in which they came";
  EXPECT_LT(place_of(html, ">worst<"), place_of(html, ">asks_much<"));
}

TEST(AuditPage, CountsActionsOfWhich99PercentAreClean) {
  const std::string html = audit_html({"", "", {row("human", "a", 990, 0), row("human", "b", 989, 0)}});
  EXPECT_NE(html.find("1 of 2 actions are clean"), std::string::npos);
  EXPECT_NE(html.find("verdict bad"), std::string::npos);
  EXPECT_NE(audit_html({"", "", {row("human", "a", 990, 0)}}).find("verdict good"), std::string::npos);
}

TEST(AuditPage, EscapesAllText) {
  AuditPageRow hostile = row("<script>", "'\"&", 0, 0);
  hostile.part = "<b>", hostile.details = "<i>", hostile.spec = "../out.json", hostile.picture = "javascript:x";
  const std::string html = audit_html({"<u>", "<s>", {hostile}});
  for (const char* tag : {"<script", "<b>", "<i>", "<u>", "<s>", "../out"}) EXPECT_EQ(html.find(tag), std::string::npos) << tag;
}

}  // namespace
}  // namespace contort
