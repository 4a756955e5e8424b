// Poses as an author would draw them. Values drawn over the whole ranges of joints put hands through chests, and the
// generator plays such a pose as it is, so its collisions are not the generator's fault.
#pragma once

#include <vector>

#include "fuzz/profile.h"
#include "model/character/character.h"
#include "model/generator.h"
#include "model/world/environment.h"
#include "model/world/environment_desc.h"

namespace contort {

// Returns true if the part, or a part that it carries, has a sole. A random pose of it drags a foot over the ground.
bool carries_sole(const Character& character, int part);

// Returns true if the action takes values of joints, as `pose` does.
bool is_pose(const OfferedAction& action);

// Returns true if the profile draws only sensible poses of this action: it has no ranges of its own for it, and does
// not ask for wild ones.
bool is_sensible_in(const Profile& profile, const Part& part, const OfferedAction& action);

// Returns the surroundings for poses that are tried on a figure at rest: obstacles, and steps, whose treads are level.
// On a slope or rough ground the figure adapts its posture, so a plane stands for these.
Environment beside_rest(const EnvironmentDesc& environment);

class WayToPose;

// The joints of a figure after the poses that were drawn for it so far; each stays until another pose moves its part.
class PosedFigure {
 public:
  // The figure at rest. The arguments must outlive this object.
  PosedFigure(const Character& character, const Environment& environment)
      : character_(character),
        environment_(environment),
        row_(character.rest_coords().begin(), character.rest_coords().end()) {}

  // Moves the joint values in use.params (those of Domain::joint_range) towards rest, halving them until no joint
  // leaves its range, and no body of the figure collides with another one, the ground or an obstacle, on two ways to
  // the pose: from rest, and from the poses before. The ground does not count for legs, which step onto it by
  // themselves. After four halvings, the values are those of rest.
  void add_sensible(const Part& part, const std::vector<ParamDef>& params, ActionUse& use);

  // Adds a pose as it is, and returns true if add_sensible() would not have changed it.
  bool add(const Part& part, const std::vector<ParamDef>& params, const ActionUse& use);

 private:
  bool is_clear(const WayToPose& way) const;

  const Character& character_;
  const Environment& environment_;
  std::vector<double> row_;
};

}  // namespace contort
