#include "formats/gltf/accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace contort {

namespace {

struct KindRow {
  int type;
  const char* name;
  std::size_t components;
};
constexpr KindRow kKinds[] = {{TINYGLTF_TYPE_SCALAR, "SCALAR", 1},
                              {TINYGLTF_TYPE_VEC3, "VEC3", 3},
                              {TINYGLTF_TYPE_VEC4, "VEC4", 4},
                              {TINYGLTF_TYPE_MAT4, "MAT4", 16}};

const KindRow& row(ElementKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

Issue bad_accessor(const std::string& pointer, const std::string& text) { return {"gltf.bad_accessor", pointer, text}; }

// Returns 0 for an unknown component type.
std::size_t component_bytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return 4;
    default: return 0;
  }
}

std::uint32_t little_endian(const unsigned char* bytes, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

// Integers map to [0, 1] or [-1, 1] by the standard's formula (section 3.6.2.2).
double fraction_value(std::uint32_t bits, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return std::max(static_cast<std::int8_t>(bits) / 127.0, -1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return bits / 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT: return std::max(static_cast<std::int16_t>(bits) / 32767.0, -1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return bits / 65535.0;
    default: return static_cast<double>(std::bit_cast<float>(bits));
  }
}

double component_value(const unsigned char* bytes, int type, bool normalized) {
  const std::uint32_t bits = little_endian(bytes, component_bytes(type));
  if (normalized) return fraction_value(bits, type);
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return static_cast<std::int8_t>(bits);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return static_cast<std::int16_t>(bits);
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return static_cast<double>(std::bit_cast<float>(bits));
    default: return bits;
  }
}

// The layout of elements in a buffer view: the place of the first one, and their distance.
struct Layout {
  int view = -1;
  std::size_t offset = 0;  // from the view's start
  std::size_t element_bytes = 0;
  std::size_t component_bytes = 0;
  std::size_t count = 0;
};

struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
  const unsigned char* at(std::size_t i) const { return first + i * stride; }
};

// The view's bytes, checked against its buffer without sums that could overflow.
Result<std::pair<const unsigned char*, std::size_t>> view_bytes(const tinygltf::Model& model, int view_index) {
  const std::string pointer = "/bufferViews/" + std::to_string(view_index);
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    return Issue{"gltf.truncated", pointer,
                 std::to_string(view.byteLength) + " bytes from byte " + std::to_string(view.byteOffset) +
                     " do not fit into buffer " + std::to_string(view.buffer) + " with " + std::to_string(data.size())};
  return std::pair(data.data() + view.byteOffset, view.byteLength);
}

Result<Done> check_alignment(const Layout& layout, std::size_t view_offset, const std::string& pointer) {
  if (layout.offset % layout.component_bytes == 0 && (layout.offset + view_offset) % layout.component_bytes == 0)
    return Done{};
  return bad_accessor(pointer, "it starts at byte " + std::to_string(layout.offset + view_offset) +
                                   " of its buffer; allowed are multiples of " +
                                   std::to_string(layout.component_bytes));
}

Result<Elements> place_elements(const tinygltf::Model& model, const Layout& layout, const std::string& pointer) {
  const auto bytes = view_bytes(model, layout.view);
  if (!bytes) return bytes.issue();
  const auto [first, length] = *bytes;
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(layout.view)];
  const std::size_t stride = view.byteStride == 0 ? layout.element_bytes : view.byteStride;
  if (stride < layout.element_bytes)
    return bad_accessor(pointer, "elements of " + std::to_string(layout.element_bytes) + " bytes are " +
                                     std::to_string(stride) + " bytes apart");
  if (const auto aligned = check_alignment(layout, view.byteOffset, pointer); !aligned) return aligned.issue();
  const bool fits = layout.count == 0 || (layout.offset <= length && length - layout.offset >= layout.element_bytes &&
                                          layout.count - 1 <= (length - layout.offset - layout.element_bytes) / stride);
  if (!fits)
    return Issue{"gltf.truncated", pointer + "/count",
                 "found " + std::to_string(layout.count) + "; buffer view " + std::to_string(layout.view) +
                     " is too short for so many elements"};
  return Elements{first + layout.offset, stride};
}

void decode(const Elements& elements, std::size_t count, std::size_t components, const tinygltf::Accessor& as,
            std::vector<double>& out) {
  const std::size_t size = component_bytes(as.componentType);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < components; ++c)
      out.push_back(component_value(elements.at(i) + c * size, as.componentType, as.normalized));
}

Result<Done> check_finite(const std::vector<double>& values, std::size_t components, const std::string& pointer) {
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  if (bad == values.end()) return Done{};
  const auto position = static_cast<std::size_t>(bad - values.begin());
  return Issue{"gltf.not_finite", pointer,
               "component " + std::to_string(position % components) + " of element " +
                   std::to_string(position / components) + " is NaN or infinite"};
}

// The index that each sparse element replaces: ascending, within the accessor.
Result<std::vector<std::size_t>> sparse_targets(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                                                const std::string& pointer) {
  const auto& indices = accessor.sparse.indices;
  const std::size_t size = component_bytes(indices.componentType);
  const bool is_unsigned = indices.componentType % 2 == 1;  // 5121, 5123, 5125
  if (size == 0 || !is_unsigned) return bad_accessor(pointer, "sparse indices must be unsigned integers");
  const auto count = static_cast<std::size_t>(accessor.sparse.count);
  const auto elements = place_elements(
      model, {indices.bufferView, static_cast<std::size_t>(indices.byteOffset), size, size, count}, pointer);
  if (!elements) return elements.issue();
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t target = little_endian(elements->at(i), size);
    if (target >= accessor.count || (i > 0 && target <= out.back()))
      return Issue{"gltf.bad_index", pointer,
                   "sparse index " + std::to_string(i) + " is " + std::to_string(target) +
                       "; allowed is an ascending list below " + std::to_string(accessor.count)};
    out.push_back(target);
  }
  return out;
}

}  // namespace

std::size_t AccessorReader::count(int accessor) const {
  return model_.accessors[static_cast<std::size_t>(accessor)].count;
}

bool AccessorReader::has_data(int accessor) const {
  const tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(accessor)];
  return a.bufferView >= 0 || a.sparse.isSparse;
}

Result<Done> AccessorReader::check_format(int index, ElementKind kind, Integers integers) const {
  const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
  if (accessor.type != row(kind).type)
    return bad_accessor(accessor_pointer(index) + "/type", std::string("allowed here is ") + row(kind).name);
  const bool is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  const bool is_short = component_bytes(accessor.componentType) > 0 && component_bytes(accessor.componentType) < 4;
  const bool is_allowed = integers == Integers::any || (integers == Integers::normalized && accessor.normalized);
  if (is_float || (is_short && is_allowed)) return Done{};
  const char* allowed = integers == Integers::none         ? "allowed here is 5126, 32-bit floats"
                        : integers == Integers::normalized ? "allowed here is 5126, or 5120 to 5123 with \"normalized\""
                                                           : "allowed here is 5126, or 5120 to 5123";
  return bad_accessor(accessor_pointer(index) + "/componentType",
                      "found " + std::to_string(accessor.componentType) + "; " + allowed);
}

Result<Done> AccessorReader::apply_sparse(const tinygltf::Accessor& accessor, const std::string& pointer,
                                          std::vector<double>& values) const {
  const auto targets = sparse_targets(model_, accessor, pointer + "/indices");
  if (!targets) return targets.issue();
  const std::size_t size = component_bytes(accessor.componentType);
  const auto components =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  const auto& source = accessor.sparse.values;
  const auto elements = place_elements(
      model_,
      {source.bufferView, static_cast<std::size_t>(source.byteOffset), size * components, size, targets->size()},
      pointer + "/values");
  if (!elements) return elements.issue();
  std::vector<double> replacing;
  decode(*elements, targets->size(), components, accessor, replacing);
  for (std::size_t i = 0; i < replacing.size(); ++i) {
    const std::size_t target = (*targets)[i / components] * components + i % components;
    if (target < values.size()) values[target] = replacing[i];  // `values` may have only the first elements
  }
  return Done{};
}

Result<std::vector<double>> AccessorReader::read_dense(const tinygltf::Accessor& accessor, const std::string& pointer,
                                                       std::size_t components, std::size_t count) const {
  if (accessor.bufferView < 0) return std::vector<double>(count * components);  // zeros, by the standard
  const std::size_t size = component_bytes(accessor.componentType);
  const auto elements = place_elements(
      model_, {accessor.bufferView, accessor.byteOffset, size * components, size, accessor.count}, pointer);
  if (!elements) return elements.issue();
  std::vector<double> out;
  out.reserve(count * components);
  decode(*elements, count, components, accessor, out);
  return out;
}

Result<Done> AccessorReader::take_numbers(std::size_t count, const std::string& pointer) {
  if (count > numbers_left_)
    return Issue{"gltf.too_large", pointer + "/count",
                 "the file has more than the allowed " + std::to_string(kMaxGltfNumbers) + " numbers in all"};
  numbers_left_ -= count;
  return Done{};
}

Result<std::vector<int>> AccessorReader::read_indices(int index, ElementKind kind) {
  const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
  const std::string pointer = accessor_pointer(index);
  const std::size_t components = row(kind).components;
  const std::size_t size = component_bytes(accessor.componentType);
  const bool is_unsigned = size > 0 && accessor.componentType % 2 == 1;  // 5121, 5123, 5125
  if (accessor.type != row(kind).type || !is_unsigned || accessor.normalized)
    return bad_accessor(pointer, std::string("allowed here are unsigned integers, ") + row(kind).name);
  if (accessor.sparse.isSparse || accessor.bufferView < 0)
    return Issue{"gltf.unsupported", pointer, "found indices that are sparse or compressed"};
  if (accessor.count > kMaxGltfNumbers) return take_numbers(accessor.count, pointer).issue();
  if (const auto taken = take_numbers(accessor.count * components, pointer); !taken) return taken.issue();
  const auto elements = place_elements(
      model_, {accessor.bufferView, accessor.byteOffset, size * components, size, accessor.count}, pointer);
  if (!elements) return elements.issue();
  std::vector<int> out;
  for (std::size_t i = 0; i < accessor.count * components; ++i) {
    const std::uint32_t value = little_endian(elements->at(i / components) + i % components * size, size);
    if (value > std::uint32_t{kMaxGltfNumbers})
      return Issue{"gltf.bad_index", pointer, "found " + std::to_string(value) + ", which is no index"};
    out.push_back(static_cast<int>(value));
  }
  return out;
}

Result<std::vector<double>> AccessorReader::read(int index, ElementKind kind, std::size_t count, Integers integers) {
  const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
  const std::string pointer = accessor_pointer(index);
  if (const auto format = check_format(index, kind, integers); !format) return format.issue();
  const std::size_t components = row(kind).components;
  count = std::min(count, accessor.count);
  if (count > kMaxGltfNumbers) return take_numbers(count, pointer).issue();
  if (const auto taken = take_numbers(count * components, pointer); !taken) return taken.issue();
  Result<std::vector<double>> dense = read_dense(accessor, pointer, components, count);
  if (!dense) return dense.issue();
  std::vector<double> out = std::move(dense).value();
  if (accessor.sparse.isSparse)
    if (const auto applied = apply_sparse(accessor, pointer + "/sparse", out); !applied) return applied.issue();
  if (const auto finite = check_finite(out, components, pointer); !finite) return finite.issue();
  return out;
}

}  // namespace contort
