#include "model/core/nearest.h"

#include <gtest/gtest.h>

#include <vector>

namespace contort {
namespace {

TEST(Nearest, CountsLettersPutInLeftOutReplacedAndSwapped) {
  EXPECT_EQ(letters_apart("check", "check"), 0);
  EXPECT_EQ(letters_apart("chek", "check"), 1);
  EXPECT_EQ(letters_apart("chceck", "check"), 1);
  EXPECT_EQ(letters_apart("chack", "check"), 1);
  EXPECT_EQ(letters_apart("hceck", "check"), 1);
  EXPECT_EQ(letters_apart("CHECK", "check"), 0);
  EXPECT_EQ(letters_apart("", "check"), 5);
  EXPECT_EQ(letters_apart("kitten", "sitting"), 3);
}

TEST(Nearest, IsTheWordThatWasMeantAndNoOther) {
  const std::vector<std::string> words = {"check", "fuzz", "replay", "report"};
  EXPECT_EQ(nearest("chek", words), "check");
  EXPECT_EQ(nearest("reprot", words), "report");
  EXPECT_EQ(nearest("frobnicate", words), "");
  EXPECT_EQ(nearest("", words), "");
  EXPECT_EQ(nearest(std::string(1 << 20, 'x'), words), "");
}

TEST(Nearest, IsAskedForBehindAList) {
  EXPECT_EQ(did_you_mean("mehc", "human, mech, quadruped"), "; did you mean \"mech\"?");
  EXPECT_EQ(did_you_mean("mehc", "\"human\", \"mech\""), "; did you mean \"mech\"?") << "names of fields are quoted";
  EXPECT_EQ(did_you_mean("dragon", "human, mech, quadruped"), "");
  EXPECT_EQ(did_you_mean("x", ""), "");
}

}  // namespace
}  // namespace contort
