// Counts the parts of a spec that a profile would not have drawn. With this count, shrinking stays within the profile:
// if a profile requires blends of at least 20 frames, a pop without any blend is not one of its failures.
#pragma once

#include <functional>

#include "fuzz/profile.h"
#include "model/generator.h"
#include "model/spec/spec.h"

namespace contort {

// Counts actions and slots that the profile does not draw; durations, blends and parameters outside of its limits and
// rules; if the profile has none of them, other speeds, stretched clips, and actions that take over a part; and poses
// that put bodies into each other, if the profile draws only sensible ones (sensible_pose.h). Items that the generator
// does not know are not counted. 0 for every drawn spec.
int profile_violations(const Spec& spec, const Profile& profile, Generator& generator);

// Returns true if a spec violates the profile no more than `original` does. The generator must outlive it.
std::function<bool(const Spec&)> within(const Profile& profile, const Spec& original, Generator& generator);

}  // namespace contort
