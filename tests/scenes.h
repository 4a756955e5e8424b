// Named scenes that tests, golden hashes and benchmarks share.
#pragma once

#include <span>
#include <string_view>

#include "model/spec/spec.h"

namespace contort {

struct NamedScene {
  std::string_view name;
  std::string_view spec_json;
};

std::span<const NamedScene> all_scenes();

// The scene's spec; the scene must exist and parse.
Spec scene(std::string_view name);

}  // namespace contort
