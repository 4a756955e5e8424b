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

// Evenly drawn numbers; other streams have other ones. Safe to call from any thread.
RawSpec draw_raw(std::int64_t seed, std::int64_t index, std::uint64_t stream = 0);

// The spec that they make: parts and parameters are chosen from what the character has, values on short lattices within
// the declared ranges. It builds.
Spec draw_spec(const DrawConfig& config, Generator& generator, std::int64_t seed, std::int64_t index);

}  // namespace contort
