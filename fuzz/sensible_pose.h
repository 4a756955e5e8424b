// Poses as an author would draw them. Values drawn over the whole ranges of joints put hands through chests, and such a
// pose says nothing about the generator, which plays it as it is.
#pragma once

#include <vector>

#include "model/character/character.h"
#include "model/generator.h"
#include "model/world/environment.h"

namespace contort {

// Whether a part carries a sole, on itself or below. A random pose of it drags a foot over the ground.
bool carries_sole(const Character& character, int part);

// Brings the joint values in use.params (those of Domain::joint_range) back towards rest, by halves, until on the way
// there from rest no body of the figure meets another one, the ground or an obstacle. After four halves, the values are
// those of rest. The figure stands at rest otherwise.
void make_sensible(const Character& character, const Part& part, const std::vector<ParamDef>& params,
                   const Environment& environment, ActionUse& use);

}  // namespace contort
