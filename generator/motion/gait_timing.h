// The timing of a gait's course: the swings of feet and the progress of the root. docs/internals/gait.md has the
// equations.
#pragma once

#include <span>

#include "generator/motion/gait_params.h"
#include "model/motion/legs.h"

namespace contort {

// The place of a foot in its cycle: steps are numbered by their stances, from the beginning.
struct FootCycle {
  int step = 0;
  double stance = 0.0;  // fraction of the stance that is over, [0, 1]
  double swing = 0.0;   // 0: stands; otherwise the fraction of the swing that is over, (0, 1)
};

// The timing of one course with these parameters and legs, which must outlive it. Times are in seconds since its begin.
class GaitTiming {
 public:
  GaitTiming(const GaitParams& params, std::span<const Leg> legs, double duration_s);

  FootCycle cycle(const Leg& leg, double time_s) const;
  double since_landing(const Leg& leg, double time_s) const;  // as a fraction of the cycle, [0, 1)

  // The times at which a stance begins, its foot is lifted, and the hips come over it; negative before the course
  // began.
  double lands_s(const Leg& leg, int step) const;
  double lifted_s(const Leg& leg, int step) const;
  double middle_s(const Leg& leg, int step) const;

  // The root's path. It ends a cycle early, so that every foot has time to return home.
  double travelled_m(double time_s) const;

  // The distance of the hips ahead of their balanced place over a foot, while they get faster (< 0: slower): that of a
  // linear inverted pendulum, acceleration * height / g, on average over half a cycle.
  double leads_m(double time_s) const;

  // The root's speed, and the fraction of the body's turn that is made, [0, 1].
  double speed_m_s(double time_s) const;
  double turned(double time_s) const;
  double turn_rad() const { return turn_rad_; }  // the wanted turn, or as much of it as there is time for
  double turn_s() const { return turn_s_; }      // time that the turn takes

  // The distance of half a cycle about a time, as a fraction of that at full speed.
  double step_share(double time_s) const;

 private:
  double turn_ramp_s() const { return 0.5 * params_.cycle_s; }  // time in which a turn gains its speed, or loses it
  double phase(const Leg& leg) const;
  double first_lift_s(const Leg& leg) const;

  const GaitParams& params_;
  int rows_ = 1;
  double speed_m_s_ = 0.0;
  double moving_s_ = 0.0;  // time from which on the root stands again
  double pendulum_s2_ = 0.0;  // height / g, times the fraction by which hips lead
  double up_s_ = 0.0;      // time for which its speed rises
  double down_s_ = 0.0;    // time for which its speed falls
  double turn_rad_ = 0.0;
  double turn_s_ = 0.0;
};

}  // namespace contort
