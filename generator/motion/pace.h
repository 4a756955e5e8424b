// The speed at which legs can make a course: ranges, speeds and accelerations of joints, and the room between legs.
#pragma once

#include "generator/motion/stand_on.h"
#include "model/core/function_ref.h"

namespace contort {

// A course that is tried before it is used.
struct CourseTrial {
  FunctionRef<GaitFrame(Gait&, const Pace& pace, double time_s)> frame_at;  // times are of the course's content
  double lasts_s = 0.0;                                                // length of the course, s of content
  double step_s = 0.0;                                                 // content in one frame, s; > 0
  double frame_s = 0.0;                                                // length of a frame of the motion
  double even_s = 0.0;      // the begin of a half cycle in which the full course moves at constant speed on level
                            // ground
  double even_for_s = 0.0;  // length of that half cycle; 0 if the course has none
};

// Tries a few fractions of the requested speed, and returns the greatest at which a course that begins as `begun` stays
// within the limits of joints and bodies; a speed of 0 if none does. A course that is far from those limits in half a
// cycle of its even part is accepted without a trial of the rest. The other arguments are as for deepest_bend().
Pace fitting_pace(const Character& character, LimbRoom& room, const Gait& begun, const CourseTrial& course,
                    std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row);

// As fitting_pace(), for a bend: the share of its depth, as the speed of a pace, at which legs can follow it, or 1 if
// they can at none. The roll of a pace is 1.
double fitting_depth(const Character& character, LimbRoom& room, const Gait& begun, const CourseTrial& course,
                     std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row);

}  // namespace contort
