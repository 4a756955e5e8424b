#include "generator/motion/aim_states.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/joint_clamp.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

// Steps of at most step_rad that together make `range`.
int steps_in(double range_rad, double step_rad) {
  return range_rad > 0.0 ? static_cast<int>(std::ceil(range_rad / step_rad - 1e-9)) : 0;
}

std::vector<double> evenly(double low, double high, double step) {
  const int steps = steps_in(high - low, step);
  if (steps == 0) return {low};
  std::vector<double> values;
  for (int i = 0; i <= steps; ++i) values.push_back(i == steps ? high : low + (high - low) * i / steps);
  return values;
}

int rings_of(const Joint& ball, double step_rad) {
  return steps_in(std::max(ball.swing_a_rad, ball.swing_b_rad), step_rad);
}

std::vector<SwingTwist> swings_of(const Joint& ball, double step_rad) {
  std::vector<SwingTwist> swings = {{}};
  const int rings = rings_of(ball, step_rad);
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < 6 * ring; ++i) {
      const det::SinCos at = det::sincos(2.0 * kPi * i / (6 * ring));
      const double share = static_cast<double>(ring) / rings;
      swings.push_back({share * ball.swing_a_rad * at.cos, share * ball.swing_b_rad * at.sin, 0.0});
    }
  return swings;
}

// Twists are angles in [-pi, pi]; of a full turn the two ends are one place.
std::vector<double> twists_of(const Joint& ball, double step_rad) {
  const double low = std::max(ball.low, -kPi);
  const double high = std::max(low, std::min(ball.high, kPi));
  std::vector<double> twists = evenly(low, high, step_rad);
  if (twists.size() > 2 && high - low > 2.0 * kPi - 1e-9) twists.pop_back();
  return twists;
}

std::vector<double> ball_places(const Joint& ball, double step_rad) {
  const std::vector<double> twists = twists_of(ball, step_rad);
  std::vector<double> places;
  for (const SwingTwist& swing : swings_of(ball, step_rad))
    for (const double twist : twists) {
      double coords[4];
      set_swing_twist(ball, {swing.a_rad, swing.b_rad, twist}, coords);
      clamp_to_range(ball, coords);
      places.insert(places.end(), coords, coords + 4);
    }
  return places;
}

// The number of places_of, without listing them; a double, because small steps of a ball overflow an int.
double place_count(const Joint& joint, double step_rad) {
  if (joint.kind == JointKind::hinge) return 1.0 + steps_in(joint.high - joint.low, step_rad);
  if (joint.kind != JointKind::ball) return 1.0;
  const double rings = rings_of(joint, step_rad);
  return (1.0 + 3.0 * rings * (rings + 1.0)) * static_cast<double>(twists_of(joint, step_rad).size());
}

// The number of states; a double, because sixteen joints overflow an int.
double state_count(const AimGeometry& geometry, double step_rad) {
  double count = 1.0;
  for (const Joint& joint : geometry.joints) count *= place_count(joint, step_rad);
  return count;
}

double listed_count(const AimGeometry& geometry, const AimSteps& steps) {
  double count = 1.0;
  for (std::size_t i = 0; i < geometry.joints.size(); ++i)
    count *=
        static_cast<double>(steps.places[i].size() / static_cast<std::size_t>(coord_size(geometry.joints[i].kind)));
  return count;
}

}  // namespace

std::vector<double> middle_of(const Joint& joint) {
  if (joint.kind == JointKind::hinge) return {0.5 * (joint.low + joint.high)};
  if (joint.kind == JointKind::prismatic) return {std::clamp(0.0, joint.low, joint.high)};
  std::vector<double> coords(4);
  const double low = std::max(joint.low, -kPi);
  set_swing_twist(joint, {0.0, 0.0, 0.5 * (low + std::max(low, std::min(joint.high, kPi)))}, coords.data());
  return coords;
}

std::vector<double> places_of(const Joint& joint, double step_rad) {
  if (joint.kind == JointKind::hinge) return evenly(joint.low, joint.high, step_rad);
  if (joint.kind == JointKind::ball) return ball_places(joint, step_rad);
  return middle_of(joint);
}

// The step is made wider until there are few enough states; joints that are still too many at the widest one stay in
// the middle, the innermost first.
AimSteps aim_steps(const AimGeometry& geometry, const AimTableOptions& options) {
  const double wanted_rad = options.joint_step_deg * kRadPerDeg;
  AimSteps steps;
  int quarter = 4;
  do {
    steps.step_rad = std::min(wanted_rad * quarter++ / 4.0, kPi);
  } while (state_count(geometry, steps.step_rad) > options.max_states && steps.step_rad < kPi);
  for (const Joint& joint : geometry.joints) steps.places.push_back(places_of(joint, steps.step_rad));
  for (std::size_t i = 0; listed_count(geometry, steps) > options.max_states; ++i)
    steps.places[i] = middle_of(geometry.joints[i]);
  steps.state_count = static_cast<int>(listed_count(geometry, steps));
  return steps;
}

}  // namespace contort
