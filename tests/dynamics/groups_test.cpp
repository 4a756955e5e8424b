// The groups of joints that dynamic control uses together: found from the parts, or declared.
#include <gtest/gtest.h>

#include "generator/dynamics/figure.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

DynamicFigure figure_of(const Character& character) {
  const std::vector<Leg> legs = find_legs(character);
  return build_figure(character, legs, {});
}

std::vector<std::string> names(const DynamicFigure& figure) {
  std::vector<std::string> out;
  for (const ControlGroup& group : figure.groups) out.push_back(group.name);
  return out;
}

// A human with declared control groups.
Result<Character> declaring(std::vector<ControlGroupDesc> groups) {
  Library library = stock_library();
  library.characters.at("human").control_groups = std::move(groups);
  return build_character({}, library);
}

TEST(Groups, AreFoundInEveryStockCharacter) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(figure_of(fixtures::human())), (Names{"arms", "back", "lower_body"}));
  EXPECT_EQ(names(figure_of(fixtures::built(fixtures::mech_choice()))), (Names{"arms", "back", "lower_body"}));
  CharacterChoice dog;
  dog.name = "quadruped";
  EXPECT_EQ(names(figure_of(fixtures::built(dog))), (Names{"limbs", "back", "lower_body"}));
}

TEST(Groups, ThoseThatACharacterDeclaresReplaceThem) {
  const Result<Character> character = declaring({{"elbows", {"arm_left/elbow", "arm_right/elbow"}, 9.0},
                                                 {"hips", {"root", "torso/lumbar_flex"}, 0.5},
                                                 {"swapped_out", {"arm_third/elbow"}, 1.0}});
  ASSERT_TRUE(character) << to_line(character.issue());
  const DynamicFigure figure = figure_of(*character);
  ASSERT_EQ(names(figure), (std::vector<std::string>{"elbows", "hips"}));
  EXPECT_EQ(figure.groups[0].handles.size(), 2U);
  EXPECT_EQ(figure.groups[0].handles[0].link, character->find_joint("arm_left/elbow"));
  EXPECT_EQ(figure.groups[0].greatest, 9.0);
  EXPECT_FALSE(figure.groups[0].moves_feet);
  EXPECT_EQ(figure.groups[1].handles.size(), 5U);
  EXPECT_TRUE(figure.groups[1].moves_feet);
  EXPECT_NE(character->hash(), fixtures::human().hash());
}

TEST(Groups, MoreThanEightFreedomsAreRefused) {
  const std::vector<std::string> nine = {"root",          "arm_left/elbow", "arm_right/elbow",
                                         "leg_left/knee", "leg_right/knee", "torso/lumbar_flex"};
  const Result<Character> character = declaring({{"nine", nine, 1.0}});
  ASSERT_FALSE(character);
  EXPECT_EQ(character.issue().code, "character.too_many_handles");
  EXPECT_EQ(character.issue().pointer, "/control_groups/0/joints");
  EXPECT_TRUE(declaring({{"eight", {nine.begin(), nine.end() - 1}, 1.0}}));
}

}  // namespace
}  // namespace contort
