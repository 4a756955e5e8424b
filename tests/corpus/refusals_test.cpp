// The reasons for which a generator refuses requests.
#include "corpus/refusals.h"

#include <gtest/gtest.h>

#include "model/generator.h"

namespace contort {
namespace {

RefusalCounts counted(const std::vector<std::string>& reasons, std::int64_t first = 0) {
  RefusalCounts counts;
  for (const std::string& reason : reasons) count_refusal(reason, first++, counts);
  return counts;
}

TEST(Refusals, ThatDifferInNumbersAloneAreOneReason) {
  const RefusalCounts counts =
      counted({"the target is 0.53 m away", "the target is 1e-05 m away", "the target is -2 m away", "arm2 is busy",
               "arm3 is busy", "x=5, y=-7.", "x=1, y=2."});
  ASSERT_EQ(counts.size(), 4U);
  EXPECT_EQ(counts.at("the target is # m away"), (RefusalCount{3, 0, "the target is 0.53 m away"}));
  EXPECT_EQ(counts.at("x=#, y=#.").cases, 2);
  EXPECT_EQ(counts.at("arm2 is busy").cases, 1);
}

TEST(Refusals, AreListedByFrequencyAndTheRestIsCounted) {
  const RefusalCounts counts = counted({"rare", "often", "often", "seldom"});
  EXPECT_EQ(refusal_lines(counts, 6, 9, 1),
            (std::vector<std::string>{"refused: 2 of 9 motions: often", "refused: 4 of 9 motions: for other reasons"}));
  EXPECT_EQ(refusal_lines(counts, 4, 9, 5).size(), 3U);
  EXPECT_TRUE(refusal_lines({}, 0, 9, 5).empty());
}

TEST(Refusals, OfShardsAddUpToThoseOfTheRun) {
  RefusalCounts sum = counted({"late 3", "late 4"}, 10);
  add_refusals(counted({"late 1", "early"}, 2), sum);
  EXPECT_EQ(sum.at("late #"), (RefusalCount{3, 2, "late 1"}));
  EXPECT_EQ(sum.at("early").cases, 1);
}

TEST(Refusals, KeepAHundredReasons) {
  RefusalCounts counts;
  for (int i = 0; i < 150; ++i) count_refusal("reason x" + std::to_string(i), i, counts);
  EXPECT_EQ(counts.size(), 100U);
}

TEST(Refusals, AreTheWordsOfTheGenerator) {
  EXPECT_EQ(reason_of({std::string(kRefusedCode), "", std::string(kRefusedText) + "too far"}), "too far");
  EXPECT_EQ(reason_of({"spec.unknown", "/a", "no such action"}), "spec.unknown at /a: no such action");
}

}  // namespace
}  // namespace contort
