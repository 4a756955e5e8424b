#include "generator/motion/place_foot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/motion/ik.h"
#include "model/core/detmath.h"
#include "model/core/math.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// Joints of leg and foot from the first one on, up to `end`.
void place_between(const Character& character, const Leg& leg, int first, int end, std::span<const double> row,
                   std::span<Rigid> world) {
  const auto place_of = [&](int part, int from) {
    const Part& own = character.parts()[static_cast<std::size_t>(part)];
    forward_kinematics(character, row, std::max(from, own.first_joint),
                       std::min(end, own.first_joint + own.joint_count), world);
  };
  const int part = character.joint(first).part;
  place_of(part, first);
  if (part != leg.foot_part) place_of(leg.foot_part, 0);
}

// Everything of leg and foot that moves with a joint of theirs.
void place_below(const Character& character, const Leg& leg, int first, std::span<const double> row,
                 std::span<Rigid> world) {
  place_between(character, leg, first, static_cast<int>(character.joints().size()), row, world);
}

// As much as leveling the foot asks for: a pair of ankles is solved from what carries it.
void place_above_foot(const Character& character, const Leg& leg, int first, std::span<const double> row,
                      std::span<Rigid> world) {
  if (!leg.has_ankle_pair) return place_below(character, leg, first, row, world);
  place_between(character, leg, first, leg.ankles[0], row, world);
}

Quat world_from_ankle(const Joint& ankle, std::span<const Rigid> world) {
  return world[static_cast<std::size_t>(ankle.parent)].q * ankle.parent_from_joint.q;
}

// The smaller angle about a unit axis that brings v to a right angle with d, or as near to one as it can.
double turn_across(const Vec3& axis, const Vec3& v, const Vec3& d) {
  const double along = glm::dot(axis, v) * glm::dot(axis, d);
  const std::array<double, 2> angles = solve_turn(glm::dot(v, d) - along, glm::dot(glm::cross(axis, v), d), -along);
  return std::fabs(angles[0]) < std::fabs(angles[1]) ? angles[0] : angles[1];
}

}  // namespace

void level_foot(const Character& character, const Leg& leg, std::span<Rigid> world, const Vec3& up_world,
                std::span<double> row) {
  const auto ankles = std::span(leg.ankles).first(static_cast<std::size_t>(leg.ankle_count));
  if (ankles.empty()) return;
  if (!leg.has_ankle_pair) return turn_axis_to(character, ankles, leg.sole, Vec3(0, 1, 0), world, up_world, row);
  const Joint& first = character.joint(ankles[0]);
  const Joint& second = character.joint(ankles[1]);
  const Vec3 up = character.sockets()[static_cast<std::size_t>(leg.sole)].joint_from_socket.q * Vec3(0, 1, 0);
  const auto angles = hinge_pair_angles({first.axis, second.axis, second.parent_from_joint.q}, up,
                                        glm::conjugate(world_from_ankle(first, world)) * up_world);
  row[static_cast<std::size_t>(first.coord)] = angles[0];
  row[static_cast<std::size_t>(second.coord)] = angles[1];
}

void place_foot(const Character& character, const Leg& leg, std::span<Rigid> world, const Rigid& world_from_sole,
                std::span<double> row) {
  constexpr int kPasses = 6;  // the leg turns the foot a little about the vertical; each pass takes that back
  const ReachChain& chain = character.parts()[static_cast<std::size_t>(leg.part)].reach.front();
  const Vec3 ankle = world_from_sole * leg.sole_from_ankle;
  const Vec3 up = world_from_sole.q * Vec3(0, 1, 0);
  const Vec3 toes = world_from_sole.q * Vec3(0, 0, 1);
  double swivel_rad = 0.0;
  reach_for(character, chain, world, ankle, swivel_rad, row);
  place_above_foot(character, leg, chain.upper, row, world);
  const Vec3 hip = world[static_cast<std::size_t>(chain.upper)].p_m;
  if (leg.has_ankle_pair) {
    const Joint& flex = character.joint(leg.ankles[0]);
    swivel_rad = turn_across(unit_or(ankle - hip, -up), world_from_ankle(flex, world) * flex.axis, toes);
  }
  // The leveled foot turns about the vertical by 1 / this when the leg turns about itself: -1 where it stands
  // upright below its hip, and without bounds where it lies level.
  const double steepness = glm::dot(unit_or(ankle - hip, -up), up);
  for (int pass = 0; pass < kPasses; ++pass) {
    reach_for(character, chain, world, ankle, swivel_rad, row);
    place_above_foot(character, leg, chain.upper, row, world);
    level_foot(character, leg, world, up, row);
    if (leg.ankle_count > 0) place_below(character, leg, leg.ankles[0], row, world);
    const Vec3 now = world_from_socket(character, world, leg.sole).q * Vec3(0, 0, 1);
    const double off_rad = det::atan2(glm::dot(up, glm::cross(now, toes)), glm::dot(now, toes));
    if (std::fabs(off_rad) < 1e-10) return;
    swivel_rad += std::fabs(off_rad) > 0.5 * kPi ? kPi : steepness * off_rad;  // the other way round, or nearly there
  }
}

}  // namespace contort
