// The speed at which legs can make a course: ranges, speeds and accelerations of joints, and the room between legs.
#pragma once

#include "generator/motion/stand_on.h"
#include "model/core/function_ref.h"

namespace contort {

// A course that is tried before it is made.
struct CourseTrial {
  FunctionRef<GaitFrame(Gait&, double pace, double time_s)> frame_at;  // times are of the course's content
  double lasts_s = 0.0;                                                // of content
  double step_s = 0.0;                                                 // of content, in a frame; > 0
  double frame_s = 0.0;                                                // of the motion
};

// Tries a few shares of the requested speed, and answers the greatest at which a course that begins as `begun` keeps to
// what joints and bodies allow, [0, 1]; 0 if it does at none of them. The rest is as for deepest_bend().
double fitting_pace(const Character& character, LimbRoom& room, const Gait& begun, const CourseTrial& course,
                    std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row);

}  // namespace contort
