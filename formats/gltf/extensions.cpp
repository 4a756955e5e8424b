#include "formats/gltf/extension_fields.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace contort {

namespace {

using json_fields::Json;

constexpr std::uint64_t kMostOfExtension = std::uint64_t{1} << 53;

// The value of a key; null if the value is no object or has no such key.
Json* member(Json& value, const char* key) {
  const auto found = value.is_object() ? value.find(key) : Json::iterator();
  return value.is_object() && found != value.end() ? &*found : nullptr;
}

// The extension of that name; null if the value has none.
Json* extension(Json& value, const char* name) {
  Json* all = member(value, "extensions");
  return all == nullptr ? nullptr : member(*all, name);
}

// Calls `visit` with each entry of a list of the root, and its index, until there is an issue.
template <class Visit>
Result<Done> each(Json& of, const char* list, Visit visit) {
  Json* entries = member(of, list);
  if (entries == nullptr || !entries->is_array()) return Done{};
  for (std::size_t i = 0; i < entries->size(); ++i)
    if (const Result<Done> visited = visit((*entries)[i], i); !visited) return visited;
  return Done{};
}

// Reads a whole number >= 0 of an extension. A missing number that is not required keeps its value.
Result<Done> take_number(Json& from, const char* key, bool required, const std::string& pointer, std::uint64_t& out) {
  const Json* value = member(from, key);
  if (value == nullptr && !required) return Done{};
  if (value == nullptr) return Issue{"gltf.missing", pointer, "\"" + std::string(key) + "\" is required"};
  if (!value->is_number_unsigned() || value->get<std::uint64_t>() > kMostOfExtension)
    return Issue{"gltf.wrong_type", pointer + "/" + key, "allowed is a whole number >= 0"};
  out = value->get<std::uint64_t>();
  return Done{};
}

std::string take_text(Json& from, const char* key, const std::string& fallback) {
  const Json* value = member(from, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : fallback;
}

// ---- EXT_meshopt_compression

Result<Done> take_view(Json& view, std::size_t index, std::vector<CompressedView>& out) {
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    Json* found = extension(view, name);
    if (found == nullptr) continue;
    const std::string pointer = "/bufferViews/" + std::to_string(index) + "/extensions/" + name;
    CompressedView taken{index, 0, 0, 0, 0, 0, take_text(*found, "mode", ""), take_text(*found, "filter", "NONE")};
    for (const auto& read : {take_number(*found, "buffer", true, pointer, taken.buffer),
                             take_number(*found, "byteOffset", false, pointer, taken.offset),
                             take_number(*found, "byteLength", true, pointer, taken.length),
                             take_number(*found, "byteStride", true, pointer, taken.stride),
                             take_number(*found, "count", true, pointer, taken.count)})
      if (!read) return read;
    out.push_back(std::move(taken));
    break;
  }
  return Done{};
}

// ---- KHR_draco_mesh_compression

Result<Done> take_primitive(Json& primitive, std::size_t mesh, std::size_t index, std::vector<DracoPrimitive>& out) {
  Json* found = extension(primitive, "KHR_draco_mesh_compression");
  if (found == nullptr) return Done{};
  const std::string place = "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(index);
  const std::string pointer = place + "/extensions/KHR_draco_mesh_compression";
  DracoPrimitive taken{mesh, index, 0, -1, {}};
  if (const auto view = take_number(*found, "bufferView", true, pointer, taken.view); !view) return view;
  std::uint64_t indices = 0;
  if (const auto read = take_number(primitive, "indices", false, place, indices); !read) return read;
  if (primitive.contains("indices")) taken.indices = static_cast<std::int64_t>(indices);
  for (const char* name : {"POSITION", "JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"}) {
    Json* attributes = member(*found, "attributes");
    if (attributes == nullptr || !attributes->is_object()) break;
    if (!attributes->contains(name)) continue;
    if (const auto id = take_number(*attributes, name, true, pointer + "/attributes", taken.attributes[name]); !id)
      return id;
  }
  primitive.erase("indices");  // the accessor has no data yet
  out.push_back(std::move(taken));
  return Done{};
}

// ---- KHR_animation_pointer

// Splits "/nodes/3/rotation" into node and property. Returns false for any other target.
bool split_pointer(const std::string& pointer, std::uint64_t& node, std::string& path) {
  constexpr std::string_view kNodes = "/nodes/";
  constexpr std::array<std::string_view, 4> kPaths = {"translation", "rotation", "scale", "weights"};
  if (!pointer.starts_with(kNodes)) return false;
  const char* end = pointer.data() + pointer.size();
  const auto [after, error] = std::from_chars(pointer.data() + kNodes.size(), end, node);
  if (error != std::errc{} || after == end || *after != '/') return false;
  path.assign(after + 1, end);
  return std::ranges::find(kPaths, path) != kPaths.end() && node <= kMostOfExtension;
}

Result<Done> take_pointer(Json& channel, const std::string& place, int& not_read) {
  Json* target = member(channel, "target");
  Json* found = target == nullptr ? nullptr : extension(*target, "KHR_animation_pointer");
  if (found == nullptr) return Done{};
  const Json* pointer = member(*found, "pointer");
  if (pointer == nullptr || !pointer->is_string())
    return Issue{"gltf.bad_pointer", place + "/target/extensions/KHR_animation_pointer", "\"pointer\" must be a text"};
  std::uint64_t node = 0;
  std::string path;
  target->erase("node");
  if (split_pointer(pointer->get<std::string>(), node, path)) {
    (*target)["node"] = node;
    (*target)["path"] = path;
  } else {
    ++not_read;  // without a node the channel is left out
  }
  return Done{};
}

}  // namespace

bool is_known_extension(const std::string& name) {
  constexpr std::string_view kNames[] = {
      "KHR_texture_transform",   "KHR_texture_basisu",        "EXT_texture_webp",        "EXT_texture_avif",
      "KHR_lights_punctual",     "EXT_lights_image_based",    "KHR_mesh_quantization",   "KHR_draco_mesh_compression",
      "EXT_meshopt_compression", "KHR_meshopt_compression",   "KHR_animation_pointer",   "KHR_node_visibility",
      "EXT_mesh_gpu_instancing", "VRMC_vrm",                  "VRMC_vrm_animation",      "VRMC_springBone",
      "VRMC_node_constraint",    "VRMC_materials_mtoon",      "KHR_xmp_json_ld"};
  return name.starts_with("KHR_materials_") || std::ranges::find(kNames, name) != std::end(kNames);
}

Result<GltfExtensions> take_extensions(Json& root, bool with_meshes) {
  GltfExtensions out;
  const auto views =
      each(root, "bufferViews", [&](Json& view, std::size_t i) { return take_view(view, i, out.views); });
  if (!views) return views.issue();
  const char* list = with_meshes ? "meshes" : "";  // meshes are not read otherwise
  const auto meshes = each(root, list, [&](Json& mesh, std::size_t m) {
    return each(mesh, "primitives",
                [&](Json& primitive, std::size_t i) { return take_primitive(primitive, m, i, out.primitives); });
  });
  if (!meshes) return meshes.issue();
  const auto animations = each(root, "animations", [&](Json& animation, std::size_t a) {
    return each(animation, "channels", [&](Json& channel, std::size_t i) {
      const std::string place = "/animations/" + std::to_string(a) + "/channels/" + std::to_string(i);
      return take_pointer(channel, place, out.pointers_not_read);
    });
  });
  if (!animations) return animations.issue();
  return out;
}

}  // namespace contort
