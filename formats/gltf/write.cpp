#include "formats/gltf/write.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <exception>
#include <sstream>

#include "formats/gltf/write_parts.h"
#include "model/core/output.h"

namespace contort {

namespace {

// GLB lengths have 32 bits, and tinygltf does not check them. Viewers refuse much smaller files anyway.
constexpr std::size_t kMaxOutputBytes = std::size_t{1} << 30;

void append(std::vector<unsigned char>& bytes, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
}

// One view per accessor: no offsets within views, no strides, and every view starts at a multiple of 4.
int add_view(tinygltf::Model& model, std::size_t first, int target) {
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = first;
  view.byteLength = bytes.size() - first;
  view.target = target;
  model.bufferViews.push_back(std::move(view));
  while (bytes.size() % 4 != 0) bytes.push_back(0);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int add_accessor(tinygltf::Model& model, tinygltf::Accessor accessor) {
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

void set_bounds(tinygltf::Accessor& accessor, std::span<const float> values, std::size_t components) {
  for (std::size_t c = 0; c < components; ++c) {
    double low = values[c];
    double high = values[c];
    for (std::size_t i = c; i < values.size(); i += components) {
      low = std::min(low, static_cast<double>(values[i]));
      high = std::max(high, static_cast<double>(values[i]));
    }
    accessor.minValues.push_back(low);
    accessor.maxValues.push_back(high);
  }
}

int accessor_type(std::size_t components) {
  if (components == 1) return TINYGLTF_TYPE_SCALAR;
  return components == 3 ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4;
}

// Writes parent_from_node at rest, except values that are the standard's defaults.
void set_rest(tinygltf::Node& node, const Rigid& rest) {
  const Quat q = glm::normalize(rest.q);
  if (rest.p_m != Vec3(0.0)) node.translation = {rest.p_m.x, rest.p_m.y, rest.p_m.z};
  if (q != kNoRotation) node.rotation = {q.x, q.y, q.z, q.w};
}

void add_nodes(tinygltf::Model& model, const Character& character) {
  for (const Joint& joint : character.joints()) {
    const int index = static_cast<int>(model.nodes.size());
    tinygltf::Node node;
    node.name = joint.name;
    set_rest(node, joint.kind == JointKind::root ? character.rest_root() : joint.parent_from_joint);
    if (joint.parent >= 0) model.nodes[static_cast<std::size_t>(joint.parent)].children.push_back(index);
    model.nodes.push_back(std::move(node));
  }
}

void add_scene(tinygltf::Model& model, const Character& character, const GltfExtras& extras) {
  tinygltf::Scene scene;
  scene.name = character.name();
  scene.nodes = {0};
  tinygltf::Value::Object notes;
  if (!extras.case_id.empty()) notes["case"] = tinygltf::Value(extras.case_id);
  if (!extras.replay.empty()) notes["replay"] = tinygltf::Value(extras.replay);
  if (!notes.empty()) scene.extras = tinygltf::Value(std::move(notes));
  model.scenes.push_back(std::move(scene));
  model.defaultScene = 0;
}

Result<std::vector<std::byte>> to_bytes(const tinygltf::Model& model) {
  std::ostringstream stream;
  try {
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
  } catch (const std::exception&) {  // nlohmann-json throws only for text that is not UTF-8
    return Issue{"gltf.bad_text", "", "a name, the case or the replay command is not UTF-8"};
  }
  const std::string text = std::move(stream).str();
  const auto bytes = std::as_bytes(std::span(text));
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

// An upper estimate: all joints with rotation and translation.
bool is_too_large(const Character& character, const Motion& motion) {
  const std::size_t per_frame = 4 + character.joints().size() * 7 * 4;
  return motion.frame_count > 0 && static_cast<std::size_t>(motion.frame_count) > kMaxOutputBytes / per_frame;
}

}  // namespace

int add_floats(tinygltf::Model& model, std::span<const float> values, std::size_t components, bool with_bounds,
               int target) {
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  const std::size_t first = bytes.size();
  for (const float value : values) append(bytes, std::bit_cast<std::uint32_t>(value), 4);
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(model, first, target);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.count = values.size() / components;
  accessor.type = accessor_type(components);
  if (with_bounds) set_bounds(accessor, values, components);
  return add_accessor(model, std::move(accessor));
}

int add_indices(tinygltf::Model& model, std::span<const std::uint32_t> indices) {
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  const std::size_t first = bytes.size();
  // 65535 is not used: some renderers interpret it as "start over", and the standard forbids it.
  const bool is_short = std::all_of(indices.begin(), indices.end(), [](std::uint32_t i) { return i < 65535; });
  for (const std::uint32_t index : indices) append(bytes, index, is_short ? 2 : 4);
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(model, first, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  accessor.componentType = is_short ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.count = indices.size();
  accessor.type = TINYGLTF_TYPE_SCALAR;
  return add_accessor(model, std::move(accessor));
}

Result<std::vector<std::byte>> write_glb(const Character& character, const Motion& motion, const GltfExtras& extras,
                                         std::optional<int> only_part) {
  if (is_too_large(character, motion))
    return Issue{"gltf.too_large", "/frame_count",
                 "found " + std::to_string(motion.frame_count) + " frames; the file would be larger than the allowed " +
                     std::to_string(kMaxOutputBytes) + " bytes"};
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "Contort";
  model.buffers.emplace_back();
  add_nodes(model, character);
  add_meshes(model, character);
  if (const auto added = add_motion(model, character, motion, only_part); !added) return added.issue();
  add_scene(model, character, extras);
  if (model.buffers[0].data.empty()) model.buffers.clear();  // neither mesh nor frames
  return to_bytes(model);
}

Result<Done> save_glb(const std::string& path, const Character& character, const Motion& motion,
                      const GltfExtras& extras, std::optional<int> only_part) {
  const auto bytes = write_glb(character, motion, extras, only_part);
  if (!bytes) return bytes.issue();
  return write_output(path, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

}  // namespace contort
