// The identity of failures and its text.
#include "checks/family.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/checks/family_text.h"

namespace contort {
namespace {

TEST(Families, AreTheThreePartsOfTheirTexts) {
  const Family elbow{"joint_range", "human", "arm_left/elbow max"};
  EXPECT_EQ(print_family(elbow), "joint_range|human|arm_left/elbow max");
  EXPECT_EQ(parse_family("joint_range|human|arm_left/elbow max"), elbow);
  EXPECT_EQ(parse_family("a|b|c|d"), (Family{"a", "b", "c|d"})) << "names have no bars";
  EXPECT_EQ(print_family({}), "");
  EXPECT_TRUE(Family{}.empty());
  EXPECT_FALSE(elbow.empty());
}

TEST(Families, HaveAllOfTheirParts) {
  for (const char* text : {"", "joint_range", "a|b", "|b|c", "a||c", "a|b|", "||"})
    EXPECT_FALSE(parse_family(text)) << text;
}

std::string draw_name() {
  std::string name(*rc::gen::inRange<std::size_t>(1, 4), ' ');
  for (char& letter : name) letter = *rc::gen::elementOf(std::string("a_0z"));
  return name;
}

Family draw_family() {
  return {draw_name(), draw_name(), draw_name() + *rc::gen::element<std::string>("", " max", "|x", "/y ~ z")};
}

RC_GTEST_PROP(FamilyText, ReadsBackAndComparesAsTheFamiliesDo, ()) {
  const Family left = draw_family(), right = draw_family();
  RC_ASSERT(parse_family(print_family(left)) == left);
  RC_ASSERT((left <=> right) == (print_family(left) <=> print_family(right)));
}

}  // namespace
}  // namespace contort
