#include "renders/html.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

TEST(Html, EscapesText) {
  EXPECT_EQ(html_text("<a href=\"x\" id='y'>&amp;"), "&lt;a href=&quot;x&quot; id=&#39;y&#39;&gt;&amp;amp;");
  EXPECT_EQ(html_text("a\nb"), "a\uFFFDb");
  EXPECT_EQ(html_lines("a<\n\nb\n"), "a&lt;\n\nb\n");
  EXPECT_EQ(html_lines(""), "");
}

TEST(Html, KeepsUrlsBelowThePage) {
  EXPECT_EQ(html_url("strips/a b#1?.png"), "strips/a%20b%231%3F.png");
  EXPECT_EQ(html_url("a..b/c.png"), "a..b/c.png");
  EXPECT_EQ(html_url("javascript:alert(1)"), "javascript%3Aalert%281%29");  // a file name, not a scheme
  for (const char* bad : {"", "/etc/passwd", "//host/x", "../x", "a/../../x", "a/.."})
    EXPECT_EQ(html_url(bad), "") << bad;
}

}  // namespace
}  // namespace contort
