#include <draco/compression/decode.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <set>

#include "formats/gltf/accessor.h"
#include "formats/gltf/compression.h"
#include "formats/gltf/limits.h"

namespace contort {

namespace {

using DracoBytes = std::span<const unsigned char>;

std::string pointer_of(const DracoPrimitive& primitive) {
  return "/meshes/" + std::to_string(primitive.mesh) + "/primitives/" + std::to_string(primitive.primitive) +
         "/extensions/KHR_draco_mesh_compression";
}

// Reads a number with seven bits in each byte, the lowest first. The highest bit of a byte means that more bytes
// follow.
std::uint64_t take_varint(DracoBytes& bytes) {
  std::uint64_t value = 0;
  for (int shift = 0; !bytes.empty() && shift < 63; shift += 7) {
    const unsigned char byte = bytes.front();
    bytes = bytes.subspan(1);
    value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if ((byte & 0x80) == 0) break;
  }
  return value;
}

// The decoder takes memory for the triangles and vertices that the header declares. So these counts are first compared
// with the accessors, and with the greatest number that so few bytes can hold. Only Draco's bitstream 2.2, which glTF
// requires, is accepted.
bool has_plain_header(DracoBytes bytes) {
  constexpr std::uint64_t kMostFacesPerByte = 64;
  if (bytes.size() < 12 || std::memcmp(bytes.data(), "DRACO\2\2\1", 8) != 0) return false;
  const bool has_metadata = (bytes[10] & 0x80) != 0;
  const bool is_edgebreaker = bytes[8] == 1;
  const std::uint64_t most = kMostFacesPerByte * bytes.size();
  bytes = bytes.subspan(is_edgebreaker ? 12 : 11);
  const std::uint64_t first = take_varint(bytes), second = take_varint(bytes);
  return !has_metadata && first <= most && second <= most && std::max(first, second) <= kMaxGltfNumbers / 3;
}

Result<DracoBytes> draco_bytes(const DracoPrimitive& primitive, const tinygltf::Model& model) {
  if (primitive.view >= model.bufferViews.size())
    return Issue{"gltf.bad_index", pointer_of(primitive), "\"bufferView\" is the index of no buffer view"};
  const tinygltf::BufferView& view = model.bufferViews[primitive.view];
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    return Issue{"gltf.truncated", pointer_of(primitive), "the view does not fit into its buffer"};
  const DracoBytes bytes = DracoBytes(data).subspan(view.byteOffset, view.byteLength);
  if (!has_plain_header(bytes)) return bad_compression(pointer_of(primitive), "found no mesh of Draco 2.2 that fits");
  return bytes;
}

Result<std::unique_ptr<draco::Mesh>> decode_mesh(const DracoPrimitive& primitive, const tinygltf::Model& model) {
  const Result<DracoBytes> bytes = draco_bytes(primitive, model);
  if (!bytes) return bytes.issue();
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (decoded.ok()) return std::move(decoded).value();
  } catch (const std::exception&) {  // there was not enough memory
  }
  return bad_compression(pointer_of(primitive), "the compressed bytes cannot be decoded");
}

// Stores new data for an accessor.
template <class Number>
void give_data(const std::vector<Number>& values, int component_type, std::size_t count, int accessor,
               tinygltf::Model& model) {
  tinygltf::Accessor& filled = model.accessors[static_cast<std::size_t>(accessor)];
  filled.bufferView = static_cast<int>(model.bufferViews.size());
  filled.byteOffset = 0;
  filled.componentType = component_type;
  filled.normalized = false;
  filled.count = count;
  filled.sparse.isSparse = false;
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteLength = values.size() * sizeof(Number);
  model.bufferViews.push_back(view);
  std::vector<unsigned char>& bytes = model.buffers.emplace_back().data;
  bytes.resize(view.byteLength);
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
}

template <class Number>
bool read_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, std::size_t components,
                 std::vector<Number>& out) {
  const auto width = static_cast<std::int8_t>(components);
  out.resize(mesh.num_points() * components);
  for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(point));
    if (index.value() >= attribute.size()) return false;
    if (!attribute.ConvertValue<Number>(index, width, out.data() + point * components)) return false;
  }
  return true;
}

// Joints are integers; all other attributes are 32-bit floats.
Result<Done> fill_attribute(const DracoPrimitive& primitive, const draco::Mesh& mesh, const std::string& name,
                            std::uint64_t id, int accessor, tinygltf::Model& model) {
  const draco::PointAttribute* attribute =
      id <= 0xFFFF ? mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id)) : nullptr;
  const std::size_t components = name == "POSITION" ? 3 : 4;
  std::vector<float> numbers;
  std::vector<std::uint16_t> joints;
  const bool is_joints = name.starts_with("JOINTS");
  const bool was_read = attribute != nullptr && (is_joints ? read_values(mesh, *attribute, components, joints)
                                                           : read_values(mesh, *attribute, components, numbers));
  if (!was_read || model.accessors[static_cast<std::size_t>(accessor)].count != mesh.num_points())
    return bad_compression(pointer_of(primitive), "found no " + name + " for each vertex of its accessor");
  if (is_joints)
    give_data(joints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, mesh.num_points(), accessor, model);
  else
    give_data(numbers, TINYGLTF_COMPONENT_TYPE_FLOAT, mesh.num_points(), accessor, model);
  return Done{};
}

void fill_indices(const draco::Mesh& mesh, int accessor, tinygltf::Model& model) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t face = 0; face < mesh.num_faces(); ++face)
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(face))) indices.push_back(corner.value());
  give_data(indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, indices.size(), accessor, model);
}

Result<Done> fill_primitive(const DracoPrimitive& primitive, std::uint64_t& numbers, tinygltf::Model& model) {
  const Result<std::unique_ptr<draco::Mesh>> decoded = decode_mesh(primitive, model);
  if (!decoded) return decoded.issue();
  numbers += 3 * (std::uint64_t{(*decoded)->num_points()} + (*decoded)->num_faces());
  if (numbers > kMaxGltfNumbers)  // many primitives may share one view
    return Issue{"gltf.too_large", pointer_of(primitive),
                 "the meshes have more than the allowed " + std::to_string(kMaxGltfNumbers) + " numbers in all"};
  tinygltf::Primitive& target = model.meshes[primitive.mesh].primitives[primitive.primitive];
  for (const auto& [name, id] : primitive.attributes)
    if (const auto accessor = target.attributes.find(name); accessor != target.attributes.end())
      if (const auto filled = fill_attribute(primitive, **decoded, name, id, accessor->second, model); !filled)
        return filled;
  if (primitive.indices < 0) return Done{};
  if (primitive.indices >= static_cast<std::int64_t>(model.accessors.size()))
    return Issue{"gltf.bad_index", pointer_of(primitive), "\"indices\" of the primitive is the index of no accessor"};
  target.indices = static_cast<int>(primitive.indices);
  target.mode = TINYGLTF_MODE_TRIANGLES;
  fill_indices(**decoded, target.indices, model);
  return Done{};
}

}  // namespace

Result<Done> fill_primitives(std::span<const DracoPrimitive> primitives, tinygltf::Model& model) {
  std::set<std::size_t> skinned;
  for (const tinygltf::Node& node : model.nodes)
    if (node.mesh >= 0 && node.skin >= 0) skinned.insert(static_cast<std::size_t>(node.mesh));
  std::uint64_t numbers = 0;
  for (const DracoPrimitive& primitive : primitives)
    if (skinned.contains(primitive.mesh))
      if (const auto filled = fill_primitive(primitive, numbers, model); !filled) return filled;
  return Done{};
}

}  // namespace contort
