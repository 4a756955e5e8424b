// A foot's step from one foothold to the next: the height of its swing over the ground, and the roll of its sole.
#pragma once

#include "generator/motion/gait_timing.h"
#include "model/motion/legs.h"
#include "model/world/environment.h"

namespace contort {

struct Step {
  int number = -1000000;  // number of the stance before the swing
  Rigid from;             // world_from_sole
  Rigid to;
  double bump_m = 0.0;     // height of the foot above the straight line
  double margin = 0.0;     // the fraction of the swing before the foot goes forward, and after
  double rise = 0.25, fall = 0.25, late = 0.0;  // as in GaitParams
  double landed_up = 0.0;  // fractions of the largest roll, [0, 1]: of the toes when the foot came to `from`,
  double leaves_up = 0.0;  // of the heel when it leaves there,
  double lands_up = 0.0;   // of the toes when it comes to `to`
};

// Finds the gentlest swing that clears the ground without being lifted much higher than needed: if a riser is near, the
// foot goes up first and then forward. Sets bump_m, at least about lift_m, and margin.
void choose_swing(const Environment& environment, const Leg& leg, double lift_m, Step& step);

// Sets the fractions of the roll: less on a path shorter than a stride, none below a riser, and toes that are raised by
// toes_up_rad from level also uphill, where an ankle has less room. `before` is the foothold before `from`.
void choose_rolling(const Environment& environment, const Leg& leg, double stride_m, double toes_up_rad,
                    const Rigid& before, Step& step);

// Returns the sole's place on its straight path, without lift and roll.
Vec3 straight_way(const Step& step, double swing);

// Returns the sole's place with lift and roll; `moving`, [0, 1], is the fraction of its roll.
Rigid swung_sole(const Environment& environment, const Leg& leg, const Step& step, const FootCycle& cycle,
                 const GaitParams& params, double moving);

}  // namespace contort
