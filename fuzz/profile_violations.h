// Counts what a profile would not have drawn. Shrinking asks, so that a minimal case stays one of those that the profile
// is about: where it asks for blends of 20 frames at least, a pop without any blend is none of its failures.
#pragma once

#include <functional>

#include "fuzz/profile.h"
#include "model/generator.h"
#include "model/spec/spec.h"

namespace contort {

// Counts actions and slots that it does not draw; durations, blends and parameters outside of its limits and rules; other
// speeds and stretched clips, and actions that take over a part, where it has none. What a generator does not know is not
// counted. 0 for every drawn spec.
int profile_violations(const Spec& spec, const Profile& profile, Generator& generator);

// Whether a spec departs no more than `original` does. The generator must outlive it.
std::function<bool(const Spec&)> within(const Profile& profile, const Spec& original, Generator& generator);

}  // namespace contort
