// From raw numbers to a spec that builds.
#pragma once

#include <array>

#include "fuzz/draw.h"
#include "fuzz/raw.h"
#include "model/character/library.h"
#include "model/spec/spec.h"

namespace contort {

// Frames to which one clip in five is stretched.
inline constexpr int kShortestStretch = 20;
inline constexpr int kLongestStretch = 120;

// Every number is read as a choice among what the library has and the profile allows.
Spec compose(const RawSpec& raw, const DrawConfig& config, const Library& library);

// Whether the ground that they make is a plane, where no feature is left out.
bool is_level(const std::array<int, kRawGround>& ground, const Profile& profile);

}  // namespace contort
