// Squats and crouches of a figure with mass: its hips go down slowly enough, and move so that its centre of mass stays
// over its feet.
#pragma once

#include "generator/motion/stand_on.h"

namespace contort {

// The centre of mass of a figure whose joints are placed so, in the world.
Vec3 center_of_mass_m(const Character& character, std::span<const Rigid> world);

struct BendCourse {
  // The root of a bend that goes so far down, [0, 1], at a progress of its course, [0, 1], with its blends.
  FunctionRef<Rigid(double deepest, double progress)> root_at;
  Vec3 center_m{0.0};  // the centre of mass before the bend, in the root's frame
  double takes_s = 0.0;
};

// The largest fraction of the way down, [0, 1], on which the centre of mass accelerates upward and downward by at most
// 6 m/s^2, as far as the root takes it along, and the hips lean by at most 12 rad/s^2, so that the soles can hold the
// figure. An animal's hips are far behind its centre of mass, which rises when they lean.
double calm_bend(const BendCourse& course);

// The largest fraction of the way down, [0, 1], up to which the centre of mass is above the part of each foot that bears:
// the less of it, the higher its heel has risen. On steep ground heels rise before the hips are above the toes.
double balanced_bend(const Character& character, std::span<const Leg> legs, const Bend& bend,
                     std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row);

// Returns the level movement of the hips, m, with which the centre of mass at the end of the way down is near the point
// where it is at its begin, or above the toes of feet whose heels have risen. `world`, `scratch` and `row` are as for
// deepest_bend().
Vec3 shift_over_feet_m(const Character& character, std::span<const Leg> legs, const Bend& bend,
                       std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row);

}  // namespace contort
