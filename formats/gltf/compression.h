// Decodes data that extensions have compressed: views by EXT_meshopt_compression, meshes by KHR_draco_mesh_compression.
// The data become new buffers of the model, so accessors read them like all other data, with the same checks.
#pragma once

#include <span>

#include "formats/gltf/extensions.h"
#include "model/core/result.h"

namespace tinygltf {
class Model;
}

namespace contort {

inline Issue bad_compression(const std::string& pointer, const std::string& text) {
  return {"gltf.bad_compression", pointer, text};
}

// Codes gltf.bad_index, .truncated, .too_large, and .bad_compression for data that the decoder refuses or that have
// another size than declared.
Result<Done> fill_views(std::span<const CompressedView> views, tinygltf::Model& model);

// Does the same for the primitives of skinned meshes. Their removed indices are restored.
Result<Done> fill_primitives(std::span<const DracoPrimitive> primitives, tinygltf::Model& model);

}  // namespace contort
