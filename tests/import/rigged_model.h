// Makes skinned models for tests: a box of skin on every joint.
#pragma once

#include <string>
#include <vector>

#include "formats/gltf/read.h"
#include "import/import.h"
#include "model/core/math.h"
#include "tests/gltf/glb_builder.h"

namespace contort::fixtures {

struct RiggedBone {
  std::string name;
  int parent = -1;
  Vec3 place{0.0};  // position in the world, metres
  Vec3 low{-0.05};  // its box, from there
  Vec3 high{0.05};
};

struct RigOptions {
  double units_per_metre = 1.0;  // for joints and vertices
  Quat turned = kNoRotation;     // the whole model, by its armature
};

// One node for each bone, below an armature (node 0); bone i is node i + 1, the mesh is the last node.
inline GlbBuilder rigged(const std::vector<RiggedBone>& bones, const RigOptions& options = {}) {
  const double k = options.units_per_metre;
  GlbBuilder b;
  const Quat& q = options.turned;
  b.root["nodes"].push_back({{"name", "Armature"}, {"rotation", {q.x, q.y, q.z, q.w}}, {"children", Json::array()}});
  std::vector<float> places, bind, weights;
  std::vector<std::uint8_t> joints;
  std::vector<std::uint16_t> indices;
  Json nodes_of_skin = Json::array();
  const auto as_float = [](double value) { return static_cast<float>(value); };
  for (std::size_t i = 0; i < bones.size(); ++i) {
    const RiggedBone& bone = bones[i];
    const Vec3 from = bone.parent < 0 ? Vec3(0.0) : bones[static_cast<std::size_t>(bone.parent)].place;
    const Vec3 step = k * (bone.place - from);
    b.root["nodes"].push_back(
        {{"name", bone.name}, {"translation", {step.x, step.y, step.z}}, {"children", Json::array()}});
    b.root["nodes"][static_cast<std::size_t>(bone.parent + 1)]["children"].push_back(i + 1);
    nodes_of_skin.push_back(i + 1);
    for (int e = 0; e < 16; ++e)
      bind.push_back(e % 5 == 0 ? 1.0F : e >= 12 && e < 15 ? as_float(-k * bone.place[e - 12]) : 0.0F);
    const std::size_t first = places.size() / 3;
    for (int corner = 0; corner < 8; ++corner) {
      for (int c = 0; c < 3; ++c)
        places.push_back(as_float(k * (bone.place[c] + ((corner >> c & 1) != 0 ? bone.high[c] : bone.low[c]))));
      for (int n = 0; n < 4; ++n) {
        joints.push_back(n == 0 ? static_cast<std::uint8_t>(i) : std::uint8_t{0});
        weights.push_back(n == 0 ? 1.0F : 0.0F);
      }
    }
    for (const int v :
         {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5})
      indices.push_back(static_cast<std::uint16_t>(first + static_cast<std::size_t>(v)));
  }
  for (Json& node : b.root["nodes"])
    if (node["children"].empty()) node.erase("children");
  Json attributes = {{"POSITION", b.add_vec3(places)},
                     {"JOINTS_0", b.add(joints, 5121, "VEC4", 4)},
                     {"WEIGHTS_0", b.add_vec4(weights)}};
  b.root["meshes"] = {{{"primitives", {{{"attributes", attributes}, {"indices", b.add(indices, 5123, "SCALAR", 1)}}}}}};
  b.root["skins"] = {{{"joints", nodes_of_skin}, {"inverseBindMatrices", b.add_mat4(bind)}}};
  b.root["nodes"].push_back({{"name", "Skin"}, {"mesh", 0}, {"skin", 0}});
  return b;
}

// A person of 1.8 m with spread arms, facing +Z.
inline std::vector<RiggedBone> person() {
  std::vector<RiggedBone> bones = {
      {"Hips", -1, {0, 1.0, 0}, {-0.15, -0.1, -0.1}, {0.15, 0.1, 0.1}},
      {"Spine", 0, {0, 1.1, 0}, {-0.15, 0.0, -0.1}, {0.15, 0.4, 0.1}},
      {"Neck", 1, {0, 1.5, 0}, {-0.05, 0.0, -0.05}, {0.05, 0.08, 0.05}},
      {"Head", 2, {0, 1.58, 0}, {-0.09, 0.0, -0.1}, {0.09, 0.22, 0.1}},
  };
  for (const double s : {1.0, -1.0}) {
    const std::string side = s > 0 ? "Left" : "Right";
    const auto box = [s](double x0, double x1, double y, double z) {
      return std::pair(Vec3(s > 0 ? x0 : -x1, -y, -z), Vec3(s > 0 ? x1 : -x0, y, z));
    };
    const int first = static_cast<int>(bones.size());
    const auto [arm0, arm1] = box(0.0, 0.28, 0.05, 0.05);
    const auto [fore0, fore1] = box(0.0, 0.25, 0.04, 0.04);
    const auto [hand0, hand1] = box(0.0, 0.18, 0.02, 0.04);
    bones.push_back({side + "Arm", 1, {0.2 * s, 1.45, 0}, arm0, arm1});
    bones.push_back({side + "ForeArm", first, {0.48 * s, 1.45, 0}, fore0, fore1});
    bones.push_back({side + "Hand", first + 1, {0.73 * s, 1.45, 0}, hand0, hand1});
    bones.push_back({side + "UpLeg", 0, {0.1 * s, 0.95, 0}, {-0.07, -0.45, -0.07}, {0.07, 0.0, 0.07}});
    bones.push_back({side + "Leg", first + 3, {0.1 * s, 0.5, 0}, {-0.05, -0.42, -0.05}, {0.05, 0.0, 0.05}});
    bones.push_back({side + "Foot", first + 4, {0.1 * s, 0.08, 0}, {-0.05, -0.08, -0.06}, {0.05, 0.0, 0.18}});
  }
  return bones;
}

// A chain of nameless joints along +Y, half a metre each.
inline std::vector<RiggedBone> worm(int count) {
  std::vector<RiggedBone> bones;
  for (int i = 0; i < count; ++i)
    bones.push_back({"x" + std::to_string(i), i - 1, {0, 0.5 * i, 0}, {-0.1, 0.0, -0.1}, {0.1, 0.5, 0.1}});
  return bones;
}

inline Result<Imported> imported(const GlbBuilder& builder, ImportOptions options = {}) {
  if (options.name.empty()) options.name = "figure";
  const Result<SkinnedAsset> asset = parse_skinned_glb(builder.glb());
  if (!asset) return asset.issue();
  return import_model(*asset, options);
}

inline Library library_of(const Imported& imported) {
  Library library = stock_library();
  for (const PartDesc& part : imported.cut.parts) library.parts[part.name] = part;
  library.characters[imported.cut.character.name] = imported.cut.character;
  return library;
}

inline Result<Character> character_of(const Imported& imported) {
  return build_character({imported.cut.character.name, {}, {}}, library_of(imported));
}

inline const PartDesc* part_in(const Imported& imported, const std::string& slot) {
  for (const PartDesc& part : imported.cut.parts)
    if (part.name == imported.cut.character.name + "_" + slot) return &part;
  return nullptr;
}

}  // namespace contort::fixtures
