#include "generator/motion/weighty_bend.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "generator/motion/foot_roll.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kLifts_m_s2 = 6.0;
constexpr double kLeans_rad_s2 = 12.0;
constexpr int kStops = 24;
constexpr int kFewestSteps = 32, kMostSteps = 120;  // of a course
constexpr double kStepsPerSecond = 60.0;

// The accelerations at a step of a course, times the square of the step's length.
struct StepChange {
  double lift_m = 0.0;
  Vec3 lean_rad{0.0};
};

std::vector<StepChange> changes_of(const BendCourse& course, double deepest, int steps) {
  const auto root_at = [&](int step) {
    return course.root_at(deepest, std::clamp(static_cast<double>(step) / steps, 0.0, 1.0));
  };
  const auto height_m = [&](const Rigid& root) { return (root * course.center_m).y; };
  std::vector<StepChange> changes;
  Rigid before = root_at(-1), now = root_at(0);
  for (int n = 0; n <= steps; ++n) {
    const Rigid after = root_at(n + 1);
    changes.push_back({height_m(after) - 2.0 * height_m(now) + height_m(before),
                       to_rotation_vector(after.q * glm::conjugate(now.q)) +
                           to_rotation_vector(before.q * glm::conjugate(now.q))});
    before = now, now = after;
  }
  return changes;
}

std::vector<Rigid> soles_of(const Character& character, std::span<const Leg> legs, std::span<const Rigid> world) {
  std::vector<Rigid> soles;
  for (const Leg& leg : legs) soles.push_back(world_from_socket(character, world, leg.sole));
  return soles;
}

Vec3 mean_place_m(std::span<const Rigid> soles) {
  Vec3 sum(0.0);
  for (const Rigid& sole : soles) sum += sole.p_m;
  return sum / static_cast<double>(soles.size());
}

// The place over which the weight should be.
struct Bearing {
  Vec3 point_m{0.0};
  double around_m = 0.0;  // as near to it as this is good enough
};

// The mean over the legs: of a sole that lies as it lay at first at an offset from it, of one that has risen on its
// toes a little behind their tips.
Bearing bearing_of(std::span<const Leg> legs, std::span<const Rigid> first, std::span<const Rigid> soles,
                   const Vec3& from_sole) {
  constexpr double kRisen_rad = 0.02, kBehindTips_m = 0.03, kOfLength = 0.25;
  Bearing mean;
  const double share = 1.0 / static_cast<double>(legs.size());
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (rotation_angle(glm::conjugate(first[i].q) * soles[i].q) > kRisen_rad) {
      mean.point_m += share * (soles[i] * (lower_end_m(legs[i], soles[i]) - Vec3(0.0, 0.0, kBehindTips_m)));
    } else {
      mean.point_m += share * (soles[i].p_m + from_sole);
      mean.around_m += share * kOfLength * (legs[i].high_m.z - legs[i].low_m.z);
    }
  }
  return mean;
}

// The distance from the centre of mass back to the part of a foot that bears, m; at most 0 above it. A foot whose heel
// has risen by some centimetres bears on its toes only.
double behind_m(const Leg& leg, const Rigid& flat, const Rigid& sole, const Vec3& center_m) {
  constexpr double kGives_m = 0.02;
  const Vec3 toes = sole * Vec3(0.0, 0.0, leg.high_m.z), heel = sole * Vec3(0.0, 0.0, leg.low_m.z);
  const Vec3 up = flat.q * Vec3(0, 1, 0), forward = flat.q * Vec3(0, 0, 1);
  const double risen_m = glm::dot(up, heel - toes), length_m = leg.high_m.z - leg.low_m.z;
  const double bears_m = risen_m > kGives_m ? length_m * kGives_m / risen_m : length_m;
  const Vec3 level(forward.x, 0.0, forward.z);
  return risen_m > kGives_m ? glm::dot(toes - center_m, level) - bears_m : 0.0;
}

}  // namespace

Vec3 center_of_mass_m(const Character& character, std::span<const Rigid> world) {
  Vec3 moment(0.0);
  double mass_kg = 0.0;
  for (std::size_t j = 0; j < world.size(); ++j) {
    const Joint& joint = character.joints()[j];
    moment += joint.mass_kg * (world[j] * joint.center_of_mass_m), mass_kg += joint.mass_kg;
  }
  return mass_kg > 0.0 ? moment / mass_kg : Vec3(0.0);
}

double balanced_bend(const Character& character, std::span<const Leg> legs, const Bend& bend,
                     std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row) {
  constexpr double kBehind_m = 0.03;  // a moving figure can be so far behind for a moment
  stand_bent(character, legs, bend.frame_at(0.0), world, scratch.world, row);
  const std::vector<Rigid> flat = soles_of(character, legs, scratch.world);
  for (int n = 1; n <= kStops; ++n) {
    stand_bent(character, legs, bend.frame_at(static_cast<double>(n) / kStops), world, scratch.world, row);
    const Vec3 center_m = center_of_mass_m(character, scratch.world);
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const Rigid sole = world_from_socket(character, scratch.world, legs[i].sole);
      if (behind_m(legs[i], flat[i], sole, center_m) > kBehind_m) return static_cast<double>(n - 1) / kStops;
    }
  }
  return 1.0;
}

double calm_bend(const BendCourse& course) {
  const int steps = std::clamp(static_cast<int>(course.takes_s * kStepsPerSecond), kFewestSteps, kMostSteps);
  const double step_s = course.takes_s / steps, most_m = kLifts_m_s2 * step_s * step_s;
  const double most_rad = kLeans_rad_s2 * step_s * step_s;
  const std::vector<StepChange> without = changes_of(course, 0.0, steps);  // those of its blends alone do not count
  for (int stop = kStops; stop > 0; --stop) {
    const double share = static_cast<double>(stop) / kStops;
    const std::vector<StepChange> with = changes_of(course, share, steps);
    bool is_calm = true;
    for (std::size_t n = 0; n < with.size() && is_calm; ++n)
      is_calm = std::fabs(with[n].lift_m - without[n].lift_m) <= most_m &&
                length(with[n].lean_rad - without[n].lean_rad) <= most_rad;
    if (is_calm) return share;
  }
  return 0.0;
}

Vec3 shift_over_feet_m(const Character& character, std::span<const Leg> legs, const Bend& bend,
                       std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row) {
  constexpr int kRefinements = 3;
  if (legs.empty()) return Vec3(0.0);
  stand_bent(character, legs, bend.frame_at(0.0), world, scratch.world, row);
  const std::vector<Rigid> first = soles_of(character, legs, scratch.world);
  const Vec3 from_sole = center_of_mass_m(character, scratch.world) - mean_place_m(first);
  GaitFrame low = bend.frame_at(1.0);
  Vec3 shift_m(0.0);
  for (int round = 0; round < kRefinements; ++round) {
    stand_bent(character, legs, low, world, scratch.world, row);
    const std::vector<Rigid> soles = soles_of(character, legs, scratch.world);
    const Bearing bearing = bearing_of(legs, first, soles, from_sole);
    Vec3 off_m = bearing.point_m - center_of_mass_m(character, scratch.world);
    off_m.y = 0.0;
    const double far_m = length(off_m);
    if (far_m <= bearing.around_m) break;
    off_m *= 1.0 - bearing.around_m / far_m;
    low.root.p_m += off_m, shift_m += off_m;
  }
  return shift_m;
}

}  // namespace contort
