// The pieces of write.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "model/character/character.h"
#include "model/core/result.h"
#include "model/motion/motion.h"

namespace tinygltf {
class Model;
}

namespace contort {

// Appends numbers to the model's only buffer and returns their accessor. An element has 1, 3 or 4 `components`.
// `with_bounds` writes the smallest and greatest value of each component, which the standard requires for positions and
// times.
int add_floats(tinygltf::Model& model, std::span<const float> values, std::size_t components, bool with_bounds,
               int target = 0);
int add_indices(tinygltf::Model& model, std::span<const std::uint32_t> indices);

// Adds meshes with their materials, each to its joint's node. The nodes must exist.
void add_meshes(tinygltf::Model& model, const Character& character);

// Adds the animation of the whole figure or, if a part is given, of that part only.
Result<Done> add_motion(tinygltf::Model& model, const Character& character, const Motion& motion,
                        std::optional<int> only_part);

}  // namespace contort
