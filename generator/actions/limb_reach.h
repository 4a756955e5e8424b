// The reach of a limb to a point: chooses the swivel, which two bones leave open, and uses travels if the bones are too
// short.
#pragma once

#include <optional>

#include "generator/actions/action.h"
#include "model/core/function_ref.h"

namespace contort {

// Brings the chain's tip to a point of the world. The swivel is chosen when the action takes the part: it keeps joints
// in their ranges and bodies apart, and is as near to the given one as possible; without a given one, it keeps the
// elbow low and the limb near its present posture. The part's travels extend only as far as necessary. Returns the
// distance of the tip from the point, m.
double reach_with_travels(const RuleInput& in, const ReachChain& chain, const Vec3& target_world_m,
                          std::optional<double> swivel_rad, Posture& posture);

// Brings the chain's tip to a target that moves: the swivel is chosen again if the target has moved by more than 3 cm
// relative to the limb's shoulder, or if bodies are too near there; and the limb turns to it at up to 150 degrees a
// second.
double follow_with_travels(const RuleInput& in, const ReachChain& chain, const Vec3& target_world_m, Posture& posture);

// The rotation of a limb about its line to the target, rad, with the least cost. It tries 24 rotations, the first one
// 0, then to either side, and finer ones beside the best. Of equal ones the first is taken, so that rounding does not
// choose; a limb on the right tries the mirror images.
double cheapest_swivel(Side side, FunctionRef<double(double swivel_rad)> cost);

// The cost of the posture of a limb that is placed in in.world: joints out of range, bodies too near, a high elbow, and
// a great distance from the posture at the action's start.
double cost_of_placed(const RuleInput& in, const Posture& posture);

}  // namespace contort
