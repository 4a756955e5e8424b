// Drawing specs. Case i of a run is a pure function of (seed, i, config): no order, thread or machine changes it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/profile.h"
#include "fuzz/raw.h"
#include "model/generator.h"
#include "model/spec/spec.h"

namespace contort {

struct DrawConfig {
  std::vector<std::string> characters;  // names in the library; at least one
  Profile profile{};
  bool operator==(const DrawConfig&) const = default;
};

// Returns evenly drawn numbers, different for each stream. Safe to call from any thread.
RawSpec draw_raw(std::int64_t seed, std::int64_t index, std::uint64_t stream = 0);

// Returns the spec for these numbers: parts and parameters are chosen from those of the character, and values lie on
// coarse grids within the declared ranges. The spec builds.
Spec draw_spec(const DrawConfig& config, Generator& generator, std::int64_t seed, std::int64_t index);

}  // namespace contort
