#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <array>

#include "formats/gltf/compression.h"
#include "formats/gltf/limits.h"

namespace contort {

namespace {

using PackedBytes = std::span<const unsigned char>;

// The decoders do not check their arguments. The extension defines their limits.
bool may_be_decoded(const CompressedView& view) {
  const bool is_vertices = view.mode == "ATTRIBUTES";
  const bool is_indices = view.mode == "INDICES" || (view.mode == "TRIANGLES" && view.count % 3 == 0);
  const bool has_stride = is_vertices ? view.stride % 4 == 0 && view.stride > 0 && view.stride <= 256
                                      : view.stride == 2 || view.stride == 4;
  const bool has_filter = view.filter == "NONE" || (is_vertices && view.filter == "EXPONENTIAL") ||
                          (is_vertices && view.filter == "QUATERNION" && view.stride == 8) ||
                          (is_vertices && view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8));
  return (is_vertices || is_indices) && has_stride && has_filter;
}

bool unpack(const CompressedView& view, PackedBytes packed, std::vector<unsigned char>& out) {
  if (view.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, packed.data(), packed.size()) == 0;
  if (view.mode == "INDICES")
    return meshopt_decodeIndexSequence(out.data(), view.count, view.stride, packed.data(), packed.size()) == 0;
  if (meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, packed.data(), packed.size()) != 0) return false;
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  return true;
}

Result<PackedBytes> packed_bytes(const CompressedView& view, const tinygltf::Model& model, const std::string& pointer) {
  if (view.buffer >= model.buffers.size())
    return Issue{"gltf.bad_index", pointer + "/buffer",
                 "found " + std::to_string(view.buffer) + ", which is the index of no buffer"};
  const std::vector<unsigned char>& data = model.buffers[view.buffer].data;
  if (view.offset > data.size() || view.length > data.size() - view.offset)
    return Issue{"gltf.truncated", pointer,
                 std::to_string(view.length) + " bytes from byte " + std::to_string(view.offset) +
                     " do not fit into buffer " + std::to_string(view.buffer) + " with " + std::to_string(data.size())};
  return PackedBytes(data).subspan(view.offset, view.length);
}

}  // namespace

Result<Done> fill_views(std::span<const CompressedView> views, tinygltf::Model& model) {
  std::uint64_t total = 0;
  for (const CompressedView& view : views) {
    const std::string pointer = "/bufferViews/" + std::to_string(view.view) + "/extensions/EXT_meshopt_compression";
    if (!may_be_decoded(view)) return bad_compression(pointer, "found a mode, stride or filter that it does not allow");
    tinygltf::BufferView& target = model.bufferViews[view.view];
    if (view.count > kMaxGltfBytes || view.count * view.stride != target.byteLength)
      return bad_compression(pointer, "found " + std::to_string(view.count) + " elements of " +
                                          std::to_string(view.stride) + " bytes for a view of " +
                                          std::to_string(target.byteLength));
    total += target.byteLength;
    if (total > kMaxGltfBytes)
      return Issue{"gltf.too_large", pointer,
                   "the views have more than the allowed " + std::to_string(kMaxGltfBytes) + " bytes in all"};
    const Result<PackedBytes> packed = packed_bytes(view, model, pointer);
    if (!packed) return packed.issue();
    std::vector<unsigned char> out(target.byteLength);
    if (!unpack(view, *packed, out)) return bad_compression(pointer, "the compressed bytes cannot be decoded");
    target.buffer = static_cast<int>(model.buffers.size());
    target.byteOffset = 0;
    model.buffers.emplace_back().data = std::move(out);
  }
  return Done{};
}

}  // namespace contort
