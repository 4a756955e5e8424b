// The end of a program on which work depends, in words and as an issue.
#include "process/ended.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

const Ending kCrash{Ending::Kind::crash, "exit 1", {}, "first words, last words"};

TEST(EndedPrograms, AreToldWithTheLastOfTheirWords) {
  EXPECT_EQ(describe(kCrash), "the program ended: exit 1; it printed: first words, last words");
  EXPECT_EQ(describe(kCrash, 10), "the program ended: exit 1; it printed: ...last words");
  EXPECT_EQ(describe({Ending::Kind::timeout, {}, {}, {}}, 10), "the program did not answer in time");
}

TEST(EndedPrograms, MakeAnIssueOfTheirWork) {
  const Result<int> done = unless_it_ends([]() -> Result<int> { return 3; });
  EXPECT_EQ(done.value(), 3);
  const Result<int> ended = unless_it_ends([]() -> Result<int> { throw ProgramEnded(kCrash); });
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.issue(), (Issue{"generator.ended", "", describe(kCrash)}));
  const Result<int> refused = unless_it_ends([]() -> Result<int> { return Issue{"other", "", "no"}; });
  EXPECT_EQ(refused.issue().code, "other");
}

}  // namespace
}  // namespace contort
