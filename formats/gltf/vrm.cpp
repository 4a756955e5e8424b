#include "formats/gltf/vrm.h"

#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;

constexpr std::size_t kMaxBones = 200;  // VRM has 55
constexpr std::size_t kMaxBoneName = 64;

// Finds the value at a path of keys; null if there is none.
const Json* find(const Json& root, std::initializer_list<const char*> keys) {
  const Json* at = &root;
  for (const char* key : keys) {
    if (!at->is_object()) return nullptr;
    const auto found = at->find(key);
    if (found == at->end()) return nullptr;
    at = &*found;
  }
  return at;
}

class Reader {
 public:
  explicit Reader(std::size_t node_count) : node_count_(node_count) {}

  Result<Done> add(const std::string& bone, const Json* node, const std::string& pointer) {
    if (bone.size() > kMaxBoneName || out_.size() >= kMaxBones)
      return Issue{"gltf.too_large", pointer, "found more bones, or a longer name, than a person has"};
    if (node == nullptr || !node->is_number_integer())
      return Issue{"gltf.wrong_type", pointer, "\"node\" must be the index of a node"};
    const bool is_index = node->is_number_unsigned() && node->get<std::uint64_t>() < node_count_;
    if (!is_index) return Issue{"gltf.bad_index", pointer, "\"node\" is the index of no node"};
    out_[bone] = static_cast<int>(node->get<std::uint64_t>());
    return Done{};
  }

  // Reads {"hips": {"node": 3}}.
  Result<Done> read_map(const Json& bones) {
    const std::string pointer = "/extensions/VRMC_vrm/humanoid/humanBones";
    if (!bones.is_object()) return Issue{"gltf.wrong_type", pointer, "allowed is an object"};
    for (const auto& [bone, value] : bones.items())
      if (const auto added = add(bone, find(value, {"node"}), pointer + "/" + bone.substr(0, kMaxBoneName)); !added)
        return added;
    return Done{};
  }

  // Reads [{"bone": "hips", "node": 3}].
  Result<Done> read_list(const Json& bones) {
    const std::string pointer = "/extensions/VRM/humanoid/humanBones";
    if (!bones.is_array()) return Issue{"gltf.wrong_type", pointer, "allowed is a list"};
    for (std::size_t i = 0; i < bones.size(); ++i) {
      const std::string here = pointer + "/" + std::to_string(i);
      const Json* bone = find(bones[i], {"bone"});
      if (bone == nullptr || !bone->is_string()) return Issue{"gltf.wrong_type", here, "\"bone\" must be a text"};
      if (const auto added = add(bone->get<std::string>(), find(bones[i], {"node"}), here); !added) return added;
    }
    return Done{};
  }

  std::map<std::string, int> take() { return std::move(out_); }

 private:
  std::size_t node_count_;
  std::map<std::string, int> out_;
};

}  // namespace

Result<std::map<std::string, int>> read_humanoid(std::string_view json, std::size_t node_count) {
  const Json root = Json::parse(json, nullptr, false);
  CONTORT_ASSERT(!root.is_discarded());
  Reader reader(node_count);
  if (const Json* bones = find(root, {"extensions", "VRMC_vrm", "humanoid", "humanBones"}); bones != nullptr) {
    if (const auto read = reader.read_map(*bones); !read) return read.issue();
  } else if (const Json* list = find(root, {"extensions", "VRM", "humanoid", "humanBones"}); list != nullptr) {
    if (const auto read = reader.read_list(*list); !read) return read.issue();
  }
  return reader.take();
}

}  // namespace contort
