// The outermost layer: splits bytes into JSON text and binary chunk. It trusts no field of the file.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "model/core/result.h"

namespace contort {

struct GltfContainer {
  std::string_view json;
  std::span<const std::byte> bin;  // The GLB's binary chunk.
  bool has_bin = false;
  std::size_t bytes_after = 0;  // bytes after the end that the GLB's header declares; they are not read
};

bool is_glb(std::span<const std::byte> bytes);

// Returns views into `bytes`. Codes gltf.truncated, gltf.bad_header, gltf.bad_chunk, gltf.unsupported.
Result<GltfContainer> split_glb(std::span<const std::byte> bytes);

// Refuses JSON that would exhaust a parser's stack or memory, before any parser sees it. Codes gltf.too_deep,
// gltf.too_large, gltf.bad_json (does not begin with an object).
Result<Done> scan_json(std::string_view json);

}  // namespace contort
