// Reads .glb and .gltf: nodes, skins and clips. Files are hostile until proven otherwise: whatever the bytes are, the
// answer is a checked Asset or one Issue, within the limits of limits.h. Images are never opened.
//
// The reader is stricter than most viewers: content without a meaning in the standard is refused with a code, not
// repaired. Some content is accepted although the standard forbids it, because exporters write it and its meaning is
// clear: accessors of 0 elements (a channel of 0 keys is left out), animation data with a byte stride, joints without a
// common root. Left out as well are channels without a node, with morph weights, or whose times have no data.
// Materials, textures and cameras are ignored, and meshes are read only on request.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "model/asset/skinned.h"
#include "model/core/result.h"

namespace contort {

// Reads a file. Buffers may be files in the folder of `path` or below it. Codes "gltf.*", with JSON pointers into the
// glTF document.
Result<Asset> read_gltf(const std::string& path);

// The same, but a fault in one channel of a clip, or in the bind matrices of a skin, does not refuse the file: it is
// listed in Asset::faults. A channel that cannot be read is left out. Rotations that are no unit quaternions are read
// as if they were; one of length 0 as the key before it.
Result<Asset> read_gltf_around_faults(const std::string& path);

// Reads a GLB in memory; all of its buffers must be inside. Opens no file.
Result<Asset> parse_glb(std::span<const std::byte> bytes);

// Reads a file with skinned meshes and VRM's names of bones. Faults in these are then faults of the file, too.
Result<SkinnedAsset> read_skinned_gltf(const std::string& path);
Result<SkinnedAsset> parse_skinned_glb(std::span<const std::byte> bytes);

}  // namespace contort
