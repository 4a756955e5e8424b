// From raw numbers to a spec that builds.
#pragma once

#include "fuzz/draw.h"
#include "fuzz/raw.h"
#include "generator/character/library.h"
#include "generator/spec.h"

namespace contort {

// Frames to which one clip in five is stretched.
inline constexpr int kShortestStretch = 20;
inline constexpr int kLongestStretch = 120;

// Every number is read as a choice among what the library has and the profile allows.
Spec compose(const RawSpec& raw, const DrawConfig& config, const Library& library);

}  // namespace contort
