// Makes a spec that builds from raw numbers.
#pragma once

#include <array>

#include "fuzz/draw.h"
#include "fuzz/raw.h"
#include "model/generator.h"
#include "model/spec/spec.h"

namespace contort {

// The lengths, in frames, to which one clip in five is stretched.
inline constexpr int kShortestStretch = 20;
inline constexpr int kLongestStretch = 120;

// Returns the spec in which every raw number is a choice among the items that the generator offers and the profile
// allows.
Spec compose(const RawSpec& raw, const DrawConfig& config, Generator& generator);

// Returns true if the ground is a plane, assuming that no feature is left out.
bool is_level(const std::array<int, kRawGround>& ground, const Profile& profile);

}  // namespace contort
