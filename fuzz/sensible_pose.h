// Poses as an author would draw them. Values drawn over the whole ranges of joints put hands through chests, and the
// generator plays such a pose as it is, so its collisions are not the generator's fault.
#pragma once

#include <vector>

#include "model/character/character.h"
#include "model/generator.h"
#include "model/world/environment.h"

namespace contort {

// Returns true if the part, or a part that it carries, has a sole. A random pose of it drags a foot over the ground.
bool carries_sole(const Character& character, int part);

// Moves the joint values in use.params (those of Domain::joint_range) towards rest, halving them until no body of the
// figure collides with another one, the ground or an obstacle on the way from rest to the pose. After four halvings,
// the values are those of rest. All other joints are at rest.
void make_sensible(const Character& character, const Part& part, const std::vector<ParamDef>& params,
                   const Environment& environment, ActionUse& use);

}  // namespace contort
