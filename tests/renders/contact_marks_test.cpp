#include "renders/contact_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "model/character/library.h"
#include "model/motion/kinematics.h"
#include "renders/shots.h"

namespace contort {
namespace {

const Character& human() {
  static const Character character = build_character(CharacterChoice{}, stock_library()).value();
  return character;
}

Motion resting() {
  Motion motion;
  motion.frame_count = 1, motion.coord_count = human().coord_count();
  motion.root = {human().rest_root()};
  motion.coords.assign(human().rest_coords().begin(), human().rest_coords().end());
  return motion;
}

std::vector<Rigid> rest_world() {
  std::vector<Rigid> world(human().joints().size());
  forward_kinematics(human(), human().rest_root(), human().rest_coords(), world);
  return world;
}

Finding finding_of(const char* check, const char* subject) { return {check, subject, "m", 0, 0, 0, -0.01, 0.5}; }

Highlight contact_highlight_of(const char* subject) { return highlighted(human(), finding_of("self_collision", subject)); }

std::ptrdiff_t count_on_top(const DrawList& list) {
  return std::ranges::count_if(list.instances, [](const DrawInstance& i) { return i.on_top; });
}

TEST(ContactMark, JoinsTheNearestColliders) {
  const Highlight pair = contact_highlight_of("arm_left/forearm ~ torso/trunk");
  ASSERT_EQ(pair.solids.size(), 2U);
  const std::vector<Rigid> world = rest_world();
  const std::optional<NearestPoints> contact = contact_of_pair(human(), pair, world);
  ASSERT_TRUE(contact.has_value());
  double least_m = std::numeric_limits<double>::infinity();
  for (const ColliderPair& judged : human().judged_colliders())
    for (const auto& [a, b] : {std::pair(judged.a, judged.b), std::pair(judged.b, judged.a)}) {
      if (std::ranges::count(pair.solids[0], a) == 0 || std::ranges::count(pair.solids[1], b) == 0) continue;
      const auto solid = [&](int i) {
        const Collider& collider = human().colliders()[static_cast<std::size_t>(i)];
        return moved(world[static_cast<std::size_t>(collider.joint)], solid_of(collider));
      };
      least_m = std::min(least_m, signed_distance(solid(a), solid(b), 1e9));
    }
  EXPECT_EQ(contact->distance_m, least_m);
  EXPECT_GT(contact->on_a_m.x, contact->on_b_m.x) << "the left forearm is on the left of the trunk";
}

TEST(ContactMark, IsNotThereWithoutAPair) {
  EXPECT_FALSE(contact_of_pair(human(), {}, rest_world()).has_value());
  EXPECT_FALSE(contact_of_pair(human(), contact_highlight_of("arm_left/forearm"), rest_world()).has_value());
  EXPECT_FALSE(contact_with_obstacle(human(), Environment(), contact_highlight_of("arm_left/forearm"), rest_world()));
}

TEST(ContactMark, IsNotThereWhereTheSolidsHaveNoPlace) {
  std::vector<Rigid> world = rest_world();
  for (Rigid& place : world) place.p_m.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(contact_of_pair(human(), contact_highlight_of("arm_left/forearm ~ torso/trunk"), world).has_value());
}

TEST(ContactMark, GoesToTheObstacle) {
  const Environment environment =
      build_environment(
          {.ground = PlaneGround{}, .obstacles = {{"far", Sphere{{9, 1, 0}, 0.1}}, {"near", Sphere{{2, 1, 0}, 0.1}}}})
          .value();
  const Highlight hand = contact_highlight_of("hand_left/hand");
  ASSERT_EQ(hand.solids.size(), 1U);
  const auto contact = contact_with_obstacle(human(), environment, hand, rest_world());
  ASSERT_TRUE(contact.has_value());
  EXPECT_NEAR(glm::length(contact->on_b_m - Vec3(2, 1, 0)), 0.1, 1e-4);
}

TEST(ContactMark, IsADotAtEitherPointAndALineWithDarkRims) {
  DrawList list;
  std::vector<Triangles> meshes;
  add_contact_mark({{1, 2, 3}, {1, 2.5, 3}, 0.5}, 2.0, list, meshes);
  ASSERT_EQ(list.instances.size(), 6U);
  EXPECT_EQ(count_on_top(list), 6);
  EXPECT_EQ(list.instances.front().color, kContactRimColor);
  EXPECT_EQ(list.instances.back().color, kContactColor) << "drawn last, over its rim";
  const std::vector<Vec3> corners = outline(list, meshes);
  for (const Vec3& corner : corners) EXPECT_LT(glm::length(corner - Vec3(1, 2.25, 3)), 0.33);
}

TEST(ContactMark, IsInShotsOfPairsAlone) {
  const Motion motion = resting();
  const auto marks = [&](const Finding* finding) {
    const Story story{.character = human(), .motion = motion, .finding = finding};
    return count_on_top(take_shots(story, std::vector<int>{0}).lists.front());
  };
  const Finding pair = finding_of("self_collision", "arm_left/forearm ~ torso/trunk"),
                joint = finding_of("joint_range", "arm_left/elbow max"),
                ground = finding_of("ground_penetration", "foot_left/foot");
  EXPECT_EQ(marks(&pair), 6);
  EXPECT_EQ(marks(&joint), 0);
  EXPECT_EQ(marks(&ground), 0);
  EXPECT_EQ(marks(nullptr), 0);
}

}  // namespace
}  // namespace contort
