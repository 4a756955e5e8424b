// Feet that stay on the ground under hips that move.
#pragma once

#include <span>

#include "generator/motion/gait.h"
#include "generator/motion/limb_room.h"
#include "model/core/function_ref.h"
#include "model/motion/legs.h"

namespace contort {

struct Stood {
  Rigid world_from_sole;
  bool fits = false;  // the sole is in its place, and all joints of leg and foot are in their ranges
};

// Like place_foot, for a sole that lies flat. If leg and ankle do not bend far enough, the heel rises about the toes,
// as little as necessary; if that does not help, the sole stays flat.
Stood stand_on(const Character& character, const Leg& leg, std::span<Rigid> world, const Rigid& world_from_sole,
               std::span<double> row);

// Hips on their way down over feet that stand, and back up.
struct Bend {
  FunctionRef<GaitFrame(double)> frame_at;  // the frame at a fraction of the way, [0, 1]
  double takes_s = 0.0;                     // from begin to end
  double peak = 1.0;                        // the greatest rate at which the fraction of the way grows, times takes_s;
                                            // 1 is an even movement
};

// Scratch for trials, as long as a character's joints and coordinates.
struct TrialSpace {
  std::span<Rigid> world;
  std::span<double> row;
};

// Puts the character into a frame: all joints move along with the root, and feet are placed below it. `world` is its
// placement in the previous frame, `scratch` its new one; coordinates of legs and feet in `row` are scratch. Returns
// true if all legs fit.
bool stand_bent(const Character& character, std::span<const Leg> legs, const GaitFrame& frame,
                std::span<const Rigid> world, std::span<Rigid> scratch, std::span<double> row);

// The largest fraction of the way on which legs and feet keep their joints' ranges and speeds, and no limb loses its
// room, [0, 1]. `world` is the shown placement of the character; its joints move along with the root. Coordinates of
// legs and feet in `row` are scratch. The room's frame is begun anew.
double deepest_bend(const Character& character, LimbRoom& room, const Bend& bend, std::span<const Rigid> world,
                    const TrialSpace& scratch, std::span<double> row);

}  // namespace contort
