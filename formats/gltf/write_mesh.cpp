#include <tiny_gltf.h>

#include <array>
#include <map>

#include "formats/gltf/write_parts.h"

namespace contort {

namespace {

using Color = std::array<double, 3>;
using Vertex = std::array<float, 6>;  // position, normal

// All triangles of one joint in one colour.
struct Surface {
  std::vector<float> positions_m;
  std::vector<float> normals;
  std::vector<std::uint32_t> indices;
};

Vertex to_vertex(const Vec3& position_m, const Vec3& normal) {
  Vertex out{};
  for (int i = 0; i < 3; ++i) {
    out[static_cast<std::size_t>(i)] = static_cast<float>(position_m[i]);
    out[static_cast<std::size_t>(i) + 3] = static_cast<float>(normal[i]);
  }
  return out;
}

// Equal corners of a piece become one vertex, which makes round shapes four times smaller. Each piece has its own map,
// because pieces share no corners and small maps are fast.
void add_triangles(Surface& surface, const Triangles& triangles) {
  std::map<Vertex, std::uint32_t> known;
  const std::size_t first = surface.positions_m.size() / 3;
  for (std::size_t i = 0; i < triangles.positions_m.size(); ++i) {
    const Vertex vertex = to_vertex(triangles.positions_m[i], triangles.normals[i]);
    const auto [place, is_new] = known.try_emplace(vertex, static_cast<std::uint32_t>(first + known.size()));
    surface.indices.push_back(place->second);
    if (!is_new) continue;
    surface.positions_m.insert(surface.positions_m.end(), vertex.begin(), vertex.begin() + 3);
    surface.normals.insert(surface.normals.end(), vertex.begin() + 3, vertex.end());
  }
}

int add_material(tinygltf::Model& model, const Color& color, std::map<Color, int>& materials) {
  const auto [place, is_new] = materials.try_emplace(color, static_cast<int>(model.materials.size()));
  if (!is_new) return place->second;
  tinygltf::Material material;
  // Uses a factor instead of COLOR_0. Both are linear in glTF, but viewers disagree more often about vertex colours.
  material.pbrMetallicRoughness.baseColorFactor = {color[0], color[1], color[2], 1.0};
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 0.75;
  model.materials.push_back(std::move(material));
  return place->second;
}

tinygltf::Primitive to_primitive(tinygltf::Model& model, const Surface& surface) {
  tinygltf::Primitive out;
  out.mode = TINYGLTF_MODE_TRIANGLES;
  out.attributes["POSITION"] = add_floats(model, surface.positions_m, 3, true, TINYGLTF_TARGET_ARRAY_BUFFER);
  out.attributes["NORMAL"] = add_floats(model, surface.normals, 3, false, TINYGLTF_TARGET_ARRAY_BUFFER);
  out.indices = add_indices(model, surface.indices);
  return out;
}

}  // namespace

void add_meshes(tinygltf::Model& model, const Character& character) {
  std::map<int, std::map<Color, Surface>> surfaces;  // by joint, then by colour, so the order is always the same
  for (const MeshPiece& piece : character.mesh()) {
    const Color color = {piece.color.x, piece.color.y, piece.color.z};
    add_triangles(surfaces[piece.joint][color], tessellate(piece.shape));
  }
  std::map<Color, int> materials;
  for (const auto& [joint, by_color] : surfaces) {
    tinygltf::Mesh mesh;
    for (const auto& [color, surface] : by_color) {
      if (surface.indices.empty()) continue;
      mesh.primitives.push_back(to_primitive(model, surface));
      mesh.primitives.back().material = add_material(model, color, materials);
    }
    if (mesh.primitives.empty()) continue;
    tinygltf::Node& node = model.nodes[static_cast<std::size_t>(joint)];
    mesh.name = node.name;
    node.mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(mesh));
  }
}

}  // namespace contort
