// From raw numbers to a spec that builds.
#pragma once

#include <array>

#include "fuzz/draw.h"
#include "fuzz/raw.h"
#include "model/generator.h"
#include "model/spec/spec.h"

namespace contort {

// Frames to which one clip in five is stretched.
inline constexpr int kShortestStretch = 20;
inline constexpr int kLongestStretch = 120;

// Every number is read as a choice among what the generator offers and the profile allows.
Spec compose(const RawSpec& raw, const DrawConfig& config, Generator& generator);

// Whether the ground that they make is a plane, where no feature is left out.
bool is_level(const std::array<int, kRawGround>& ground, const Profile& profile);

}  // namespace contort
