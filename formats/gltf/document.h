// The JSON layer: every value that we read must have the type, range and target that glTF requires; otherwise the file
// is refused with a pointer to the value. tinygltf drops such values silently, and crashes on some.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/gltf/extensions.h"
#include "model/core/result.h"

namespace contort {

struct BufferRef {
  std::string uri;
  bool has_uri = false;
  std::uint64_t byte_length = 0;  // >= 1
};

struct GltfDocument {
  // The document reduced to the values that we read: no images, extensions or extras, and meshes only on request, so
  // that no parser reads hostile ones. No buffers either; those are in `buffers`.
  std::string json;
  std::vector<BufferRef> buffers;
  GltfExtensions extensions;
};

enum class Meshes : std::uint8_t { leave_out, read };

// Codes gltf.bad_json, .wrong_type, .missing, .out_of_range, .bad_index, .too_large, .unsupported, .bad_pointer.
Result<GltfDocument> check_document(std::string_view json, Meshes meshes = Meshes::leave_out);

}  // namespace contort
