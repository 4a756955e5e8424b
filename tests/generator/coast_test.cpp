// Coasting continues the last step, unlike a blend, which stays between its ends.
#include <gtest/gtest.h>

#include "generator/motion/blend.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

struct Steps {
  const Character& human = *fixtures::shared_human();
  std::size_t part = static_cast<std::size_t>(human.find_part("arm_left"));
  std::size_t elbow = static_cast<std::size_t>(fixtures::joint(human, "arm_left/elbow").coord);
  Posture before = at(0.2), now = at(0.3);

  Posture at(double elbow_rad) const {
    Posture posture;
    posture.coords.assign(human.rest_coords().begin(), human.rest_coords().end());
    posture.coords[elbow] = elbow_rad;
    return posture;
  }
};

TEST(Coast, GoesOnByAsManyOfTheLastSteps) {
  const Steps steps;
  for (const double count : {0.0, 0.5, 2.0}) {
    Posture then = steps.now;
    coast_part(steps.human, steps.part, steps.before, steps.now, count, then);
    EXPECT_NEAR(then.coords[steps.elbow], 0.3 + 0.1 * count, 1e-12) << count;
  }
}

TEST(Coast, ABlendStaysBetweenItsEnds) {
  const Steps steps;
  Posture then = steps.now;
  blend_part(steps.human, steps.part, steps.before, steps.now, 3.0, then);
  EXPECT_EQ(then.coords, steps.now.coords);
}

}  // namespace
}  // namespace contort
