// Loads the bytes of a document's buffers: the GLB's binary chunk, data: URIs, and files beside the asset. No other
// code opens a file because another file says so.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "formats/gltf/document.h"
#include "model/core/result.h"

namespace contort {

struct BufferSource {
  std::span<const std::byte> bin;  // The binary chunk of the GLB.
  bool has_bin = false;
  // The folder in or below which external files may lie, after every symbolic link has been followed. "" allows none.
  std::string folder;
};

// Returns one entry for each buffer, exactly byte_length long. It is empty for a buffer without data, which is an
// error only if something reads from it. Codes gltf.bad_uri, gltf.missing_file, gltf.truncated, gltf.too_large.
Result<std::vector<std::vector<unsigned char>>> load_buffers(std::span<const BufferRef> buffers,
                                                             const BufferSource& source);

}  // namespace contort
