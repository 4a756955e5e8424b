#include "renders/check_words.h"

#include <gtest/gtest.h>

#include <set>

#include "checks/check.h"
#include "renders/glossary.h"

namespace contort {
namespace {

TEST(CheckWords, EveryCheckHasAPlainNameOfItsOwn) {
  std::set<std::string> titles;
  for (const CheckDef& check : all_checks()) {
    EXPECT_NE(check_title(check.name), check.name);
    EXPECT_TRUE(titles.insert(check_title(check.name)).second) << check.name;
  }
  EXPECT_EQ(check_title("of_tomorrow"), "of_tomorrow");
}

TEST(Glossary, ExplainsWordsWhereTheyStand) {
  for (const char* word : {"case", "failure", "cause", "severity", "minimal case", "baseline"})
    EXPECT_TRUE(term_html(word).starts_with("<abbr title='")) << word;
  EXPECT_TRUE(term_html("case", "3 cases").ends_with(">3 cases</abbr>"));
  EXPECT_EQ(term_html("<b>"), "&lt;b&gt;");
  EXPECT_NE(glossary_html().find("<dt>minimal case</dt>"), std::string::npos);
}

}  // namespace
}  // namespace contort
