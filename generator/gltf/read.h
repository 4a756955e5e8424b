// Reads .glb and .gltf: nodes, skins and clips. Files are hostile until proven otherwise: whatever the bytes are, the
// answer is a checked GltfAsset or one Issue, within the limits of limits.h. Images are never opened.
//
// Stricter than most viewers: what the standard leaves no meaning for is refused by name, not repaired. Two things that
// it forbids are let through, because they mean no harm and real files have them: accessors of 0 elements (a channel of
// 0 keys is left out), and animation data with a byte stride. Not looked at: meshes, materials, textures, cameras.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "generator/core/result.h"
#include "generator/gltf/asset.h"

namespace contort {

// Buffers may be files in the folder of `path` or below it. Codes "gltf.*", with JSON pointers into the glTF document.
Result<GltfAsset> read_gltf(const std::string& path);

// A GLB in memory; all of its buffers must be inside. Reads no file.
Result<GltfAsset> parse_glb(std::span<const std::byte> bytes);

}  // namespace contort
