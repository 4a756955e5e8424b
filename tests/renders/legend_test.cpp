// The legend names the signs that a strip shows, and no others.
#include "renders/legend.h"

#include <gtest/gtest.h>

#include "model/character/library.h"
#include "renders/contact_marks.h"
#include "renders/range_marks.h"
#include "renders/response_marks.h"

namespace contort {
namespace {

DrawInstance sign(const Vec3& color, bool ghost = false) {
  DrawInstance instance;
  instance.color = color, instance.ghost = ghost, instance.mark = true;
  return instance;
}

TEST(Legend, NamesOnlyTheSignsThatOccur) {
  const Result<Character> human = build_character({"human", {}, {}}, stock_library());
  ASSERT_TRUE(human);
  const Motion motion;
  Finding finding;
  finding.check = "joint_range";
  std::vector<DrawList> lists(2);
  EXPECT_EQ(legend_of({*human, motion}, lists), "");
  lists[0].instances = {sign(kGhostColor, true), sign(kImpactColor)};
  lists[1].scenery.obstacles = {sign(Vec3(0.3))};
  EXPECT_EQ(legend_of({*human, motion}, lists), "grey: target motion; magenta arrow: blow; violet: obstacle");
  lists = {DrawList{}};
  lists[0].instances = {sign(kAllowedColor, true), sign(kMarkerColor)};
  EXPECT_EQ(legend_of({*human, motion, &finding}, lists),
            "green: range of the joint, red: beyond it; yellow dot: joint of the failure");
  lists[0].instances = {sign(kBalancedColor, true), sign(kContactColor)};
  EXPECT_EQ(legend_of({*human, motion}, lists),
            "green or red patch: area under the feet, ball: balance point; yellow line: nearest or deepest points");
}

}  // namespace
}  // namespace contort
