// foot_slide: a foot on the ground must stay where it was put. Feet are the bodies that touch the ground at rest. The
// check follows each corner, end or centre of a foot's colliders: the point of its surface that was lowest when it
// reached the ground. While this point is within 2 mm of the ground, it must be within 2 cm of where it came down. So a
// foot may roll from heel to toe and turn on its ball, but not glide. The generator's intent is not used.
#include <array>
#include <cmath>

#include "checks/check.h"
#include "checks/feet_findings.h"
#include "checks/fixed_limits.h"
#include "model/geometry/distance.h"
#include "model/geometry/solid_points.h"

namespace contort {

namespace {

constexpr double kContact_m = 0.002;
constexpr double kFoot_m = 0.005;  // greatest height of a foot above the ground at rest

struct SolePoint {
  int subject = 0;
  int joint = 0;
  Vec3 core_m{0.0};  // in the joint's frame
  double radius_m = 0.0;
  bool touches = false;
  Vec3 material_m{0.0};   // in the joint's frame: the point that touched first
  Vec3 came_down_m{0.0};  // in the world
};

std::vector<Rigid> rest_frames(const Character& character) {
  std::vector<Rigid> world(character.joints().size());
  world[0] = character.rest_root();
  for (std::size_t j = 1; j < world.size(); ++j) {
    const Joint& joint = character.joints()[j];
    world[j] = world[static_cast<std::size_t>(joint.parent)] * joint.parent_from_joint;
  }
  return world;
}

double lowest_of(std::span<const SolePoint> points, std::span<const Rigid> world) {
  double lowest = 1e9;
  for (const SolePoint& p : points)
    lowest = std::min(lowest, (world[static_cast<std::size_t>(p.joint)] * p.core_m).y - p.radius_m);
  return lowest;
}

std::vector<SolePoint> points_of(const Character& character, int b) {
  const Body& body = character.bodies()[static_cast<std::size_t>(b)];
  std::vector<SolePoint> points;
  for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c) {
    const Solid solid = solid_of(character.colliders()[static_cast<std::size_t>(c)]);
    for (const Vec3& point : core_points(solid))
      points.push_back({b, body.joint, point, solid.radius_m, false, {}, {}});
  }
  return points;
}

std::vector<SolePoint> points_of_feet(const Character& character) {
  const std::vector<Rigid> rest = rest_frames(character);
  std::vector<SolePoint> all;
  for (int b = 0; b < static_cast<int>(character.bodies().size()); ++b)
    if (const std::vector<SolePoint> points = points_of(character, b); lowest_of(points, rest) < kFoot_m)
      all.insert(all.end(), points.begin(), points.end());
  return all;
}

// The distance that the point has slid; negative while it does not touch the ground.
double slide_m(SolePoint& p, const Rigid& world_from_joint, const Environment& ground) {
  if (!p.touches) {
    const Vec3 core = world_from_joint * p.core_m;
    if (ground.is_surely_over_ground(core, p.radius_m, kContact_m)) return -1.0;
    const Surface beneath = ground.nearest_ground(core);
    if (!(beneath.distance_m - p.radius_m <= kContact_m)) return -1.0;
    p.touches = true;
    p.came_down_m = core - p.radius_m * beneath.normal;
    p.material_m = inverse(world_from_joint) * p.came_down_m;
    return 0.0;
  }
  const Vec3 now = world_from_joint * p.material_m;
  const Surface beneath = ground.nearest_ground(now);
  p.touches = beneath.distance_m <= kContact_m;
  if (!p.touches) return -1.0;
  const Vec3 way = now - p.came_down_m;
  const Vec3 along = way - glm::dot(way, beneath.normal) * beneath.normal;
  return std::sqrt(glm::dot(along, along));
}

// With dynamics, figures may tip over the edges of their soles and fly; the check balance judges these frames.
bool is_judged(const Motion& motion, int frame) {
  const std::vector<Stance>& stances = motion.response.stances;
  return stances.empty() || stances[static_cast<std::size_t>(frame)].footing == Footing::standing;
}

}  // namespace

int foot_slide_subject_count(const Character& character) { return static_cast<int>(character.bodies().size()); }

Subject foot_slide_subject(const Character& character, int subject) {
  return {character.bodies()[static_cast<std::size_t>(subject)].name, "m"};
}

void foot_slide_measure(const CheckInput& in, MarginFold& fold) {
  std::vector<SolePoint> points = points_of_feet(in.character);
  std::vector<double> most(in.character.bodies().size());
  for (int frame = 0; frame < in.motion.frame_count; ++frame) {
    std::ranges::fill(most, -1.0);
    for (SolePoint& p : points) {
      double& worst = most[static_cast<std::size_t>(p.subject)];
      worst = std::max(worst, slide_m(p, in.world_at(frame)[static_cast<std::size_t>(p.joint)], in.environment));
      if (!is_judged(in.motion, frame)) p.touches = false;
    }
    for (std::size_t b = 0; b < most.size() && is_judged(in.motion, frame); ++b)
      if (most[b] >= 0.0) fold.report(static_cast<int>(b), frame, kSlide_m - most[b]);
  }
}

ClipCheckResult foot_slide_in_clip(const ClipInput& in) { return judge_feet_in_clip(in, FootCheck::slide); }

}  // namespace contort
