// Drawing specs. Case i of a run is a pure function of (seed, i, characters): no order, thread or machine changes it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "generator/character/library.h"
#include "generator/spec.h"

namespace contort {

struct DrawConfig {
  std::vector<std::string> characters;  // names in the library; at least one
  bool operator==(const DrawConfig&) const = default;
};

// A spec that builds: names, parts and parameters are chosen from what the character has, values on short lattices
// within the declared ranges. Safe to call from any thread.
Spec draw_spec(const DrawConfig& config, const Library& library, std::int64_t seed, std::int64_t index);

}  // namespace contort
