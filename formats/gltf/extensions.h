// Extensions about the place of data: compressed views and meshes, and channels that name their target by a pointer.
// They are removed from the document before any other code reads it, so that other code only needs plain glTF.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace contort {

// A buffer view that EXT_meshopt_compression fills.
struct CompressedView {
  std::size_t view = 0;
  std::uint64_t buffer = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t stride = 0;
  std::uint64_t count = 0;
  std::string mode;
  std::string filter;
};

// A primitive whose attributes and triangles KHR_draco_mesh_compression fills.
struct DracoPrimitive {
  std::size_t mesh = 0;
  std::size_t primitive = 0;
  std::uint64_t view = 0;
  std::int64_t indices = -1;                        // index of the accessor; -1 if there is none
  std::map<std::string, std::uint64_t> attributes;  // Draco's numbers of the attributes
};

struct GltfExtensions {
  std::vector<CompressedView> views;
  std::vector<DracoPrimitive> primitives;
  int pointers_not_read = 0;  // channels of KHR_animation_pointer that move no node
};

// Returns true if the extension is supported, or can be ignored even if a file requires it.
bool is_known_extension(const std::string& name);

}  // namespace contort
