// Makes small GLB files for tests, good ones and bad ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace contort::fixtures {

using Json = nlohmann::json;
using ByteList = std::vector<std::byte>;

inline void append_u32(ByteList& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i)));
}

inline ByteList to_bytes(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// JSON text and binary chunk to a GLB. Both are padded as the standard wants.
inline ByteList pack_glb(std::string json, ByteList bin) {
  while (json.size() % 4 != 0) json += ' ';
  while (bin.size() % 4 != 0) bin.push_back(std::byte{0});
  const std::size_t bin_bytes = bin.empty() ? 0 : 8 + bin.size();
  ByteList out = to_bytes("glTF");
  append_u32(out, 2);
  append_u32(out, static_cast<std::uint32_t>(12 + 8 + json.size() + bin_bytes));
  append_u32(out, static_cast<std::uint32_t>(json.size()));
  append_u32(out, 0x4E4F534A);
  const ByteList text = to_bytes(json);
  out.insert(out.end(), text.begin(), text.end());
  if (bin.empty()) return out;
  append_u32(out, static_cast<std::uint32_t>(bin.size()));
  append_u32(out, 0x004E4942);
  out.insert(out.end(), bin.begin(), bin.end());
  return out;
}

struct GlbBuilder {
  Json root = {{"asset", {{"version", "2.0"}}}};
  ByteList bin;

  // Raw elements behind a new buffer view and accessor; the accessor's index.
  template <class T>
  int add(const std::vector<T>& values, int component_type, const std::string& type, std::size_t components,
          bool normalized = false) {
    while (bin.size() % 4 != 0) bin.push_back(std::byte{0});
    const std::size_t first = bin.size();
    bin.resize(first + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(bin.data() + first, values.data(), values.size() * sizeof(T));
    const std::size_t length = std::max<std::size_t>(values.size() * sizeof(T), 1);
    bin.resize(std::max(bin.size(), first + length));
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", first}, {"byteLength", length}});
    Json accessor = {{"bufferView", root["bufferViews"].size() - 1},
                     {"componentType", component_type},
                     {"count", values.size() / components},
                     {"type", type}};
    if (normalized) accessor["normalized"] = true;
    root["accessors"].push_back(accessor);
    return static_cast<int>(root["accessors"].size()) - 1;
  }

  int add_scalars(const std::vector<float>& values) { return add(values, 5126, "SCALAR", 1); }
  int add_vec3(const std::vector<float>& values) { return add(values, 5126, "VEC3", 3); }
  int add_vec4(const std::vector<float>& values) { return add(values, 5126, "VEC4", 4); }
  int add_mat4(const std::vector<float>& values) { return add(values, 5126, "MAT4", 16); }

  void add_channel(std::size_t clip, int node, const std::string& path, int input, int output,
                   const std::string& interpolation = "LINEAR") {
    Json& animation = root["animations"][clip];
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  // The document with its buffer: the binary chunk, unless another is named.
  Json document() const {
    Json out = root;
    if (!bin.empty() && !out.contains("buffers")) out["buffers"] = {{{"byteLength", bin.size()}}};
    return out;
  }
  ByteList glb() const { return pack_glb(document().dump(), bin); }
};

// Three joints in a chain with a skin, and two clips: a quarter turn of the first joint in one second, and a movement
// of the third. It has every feature that read_gltf reads once.
inline GlbBuilder small_arm() {
  GlbBuilder b;
  b.root["nodes"] = {{{"name", "upper"}, {"children", {1}}, {"translation", {0, 1, 0}}},
                     {{"name", "lower"}, {"children", {2}}, {"translation", {0, -0.5, 0}}},
                     {{"name", "hand"}, {"scale", {1, 2, 1}}},
                     {{"name", "body"}, {"mesh", 0}, {"skin", 0}}};
  b.root["meshes"] = {{{"primitives", Json::array()}}};
  b.root["scenes"] = {{{"nodes", {0, 3}}}};
  b.root["scene"] = 0;
  std::vector<float> bind;
  for (int joint = 0; joint < 3; ++joint)
    for (int i = 0; i < 16; ++i) bind.push_back(i % 5 == 0 ? 1.0F : i == 13 ? static_cast<float>(joint) : 0.0F);
  b.root["skins"] = {{{"joints", {0, 1, 2}}, {"inverseBindMatrices", b.add_mat4(bind)}, {"skeleton", 0}}};
  const int times = b.add_scalars({0.0F, 1.0F});
  const float half = 0.70710678F;
  b.root["animations"] = {{{"name", "wave"}}, {{"name", "push"}}};
  const int turns = b.add_vec4({0, 0, 0, 1, half, 0, 0, half});
  const int push_times = b.add_scalars({0.25F, 0.5F, 2.0F});  // one by one: the numbers of accessors matter
  const int places = b.add_vec3({0, 0, 0, 1, 0, 0, 1, 2, 3});
  b.add_channel(0, 0, "rotation", times, turns);
  b.add_channel(1, 2, "translation", push_times, places, "STEP");
  return b;
}

}  // namespace contort::fixtures
