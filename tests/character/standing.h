// The stance of a character at rest, for tests of the stock characters.
#pragma once

#include <algorithm>

#include "model/geometry/distance.h"
#include "model/motion/kinematics.h"
#include "tests/character/stock.h"
#include "tests/stage_evaluator.h"

namespace contort::fixtures {

inline std::vector<Rigid> world_at_rest(const Character& character) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  return world;
}

// The closest judged pair at rest, and its name.
inline std::pair<double, std::string> clearance(const Character& character) {
  const std::vector<Rigid> world = world_at_rest(character);
  const auto solid = [&](int c) {
    const Collider& collider = character.colliders()[static_cast<std::size_t>(c)];
    return moved(world[static_cast<std::size_t>(collider.joint)], solid_of(collider.shape));
  };
  std::pair<double, std::string> least{1e9, ""};
  for (const ColliderPair& pair : character.judged_colliders()) {
    const double distance_m = signed_distance(solid(pair.a), solid(pair.b), 0.1);
    const std::string name = character.colliders()[static_cast<std::size_t>(pair.a)].name + " " +
                             character.colliders()[static_cast<std::size_t>(pair.b)].name;
    least = std::min(least, {distance_m, name});
  }
  return least;
}

struct LowestPoint {
  const Rigid& world;
  double operator()(const Sphere& s) const { return (world * s.center_m).y - s.radius_m; }
  double operator()(const Capsule& c) const { return std::min((world * c.a_m).y, (world * c.b_m).y) - c.radius_m; }
  double operator()(const Box& b) const {
    double low = 1e9;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Quat q = from_rotation_vector(b.rotation_deg * kRadPerDeg);
      low = std::min(low, (world * (b.center_m + q * (side * b.half_m))).y);
    }
    return low;
  }
  double operator()(const ConvexHull& hull) const {
    double low = 1e9;
    for (const Vec3& p : hull.points_m) low = std::min(low, (world * p).y);
    return low;
  }
};

inline double lowest_point(const Character& character) {
  const std::vector<Rigid> world = world_at_rest(character);
  double low = 1e9;
  for (const Collider& c : character.colliders())
    low = std::min(low, std::visit(LowestPoint{world[static_cast<std::size_t>(c.joint)]}, c.shape));
  return low;
}

inline std::string text_of(const CharacterChoice& choice) {
  std::string text =
      choice.attachments.empty() ? "" : choice.attachments[0].object + " on " + choice.attachments[0].slot;
  for (const auto& [slot, part] : choice.parts) text += " " + slot + "=" + part;
  return text;
}

// No two judged colliders touch, and the lowest one is on the ground.
inline void expect_stands_free(const CharacterChoice& choice) {
  const Result<Character> character = build_character(choice, stock_library());
  ASSERT_TRUE(character.ok()) << text_of(choice) << ": " << to_line(character.issue());
  const auto [distance_m, pair] = clearance(*character);
  EXPECT_GT(distance_m, 0.0) << text_of(choice) << ": " << pair;
  EXPECT_NEAR(lowest_point(*character), 0.0, 1e-12) << text_of(choice);
}

inline void expect_no_findings_at_rest(const CharacterChoice& choice) {
  Spec spec;
  spec.character = choice;
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage.ok());
  StageEvaluator evaluator;
  for (const Finding& finding : evaluator.run(*stage).findings) ADD_FAILURE() << text_of(choice) << finding.subject;
}

}  // namespace contort::fixtures
