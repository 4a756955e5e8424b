// The speed at which legs can make a course: ranges, speeds and accelerations of joints, and the room between legs.
#pragma once

#include "generator/motion/stand_on.h"
#include "model/core/function_ref.h"

namespace contort {

// A course that is tried before it is made.
struct CourseTrial {
  FunctionRef<GaitFrame(Gait&, const Pace& pace, double time_s)> frame_at;  // times are of the course's content
  double lasts_s = 0.0;                                                // of content
  double step_s = 0.0;                                                 // of content, in a frame; > 0
  double frame_s = 0.0;                                                // of the motion
  double even_s = 0.0;      // when a half cycle begins in which the full course goes evenly on level ground
  double even_for_s = 0.0;  // how long that half cycle is; 0 where the course has none
};

// Tries a few shares of the requested speed, and answers the greatest at which a course that begins as `begun` keeps to
// what joints and bodies allow; a speed of 0 if it does at none of them. A course that is far from those limits in half a
// cycle of its even part is taken without a trial of the rest. The other arguments are as for deepest_bend().
Pace fitting_pace(const Character& character, LimbRoom& room, const Gait& begun, const CourseTrial& course,
                    std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row);

}  // namespace contort
