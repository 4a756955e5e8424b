// Skinned meshes.
#include <tiny_gltf.h>

#include <algorithm>

#include "formats/gltf/from_model.h"

namespace contort {

namespace {

class PrimitiveReader {
 public:
  PrimitiveReader(const tinygltf::Primitive& primitive, AccessorReader& accessors, std::size_t joint_count,
                  std::string pointer)
      : primitive_(primitive), accessors_(accessors), joint_count_(joint_count), pointer_(std::move(pointer)) {}

  Result<Done> read(SkinnedMesh& out) {
    const int positions = attribute("POSITION");
    if (!is_solid() || positions < 0 || attribute("JOINTS_0") < 0) return Done{};
    if (!accessors_.has_data(positions))
      return Issue{"gltf.unsupported", pointer_,
                   "the positions have no data of their own: compressed meshes are not read"};
    const auto places = accessors_.read(positions, ElementKind::vec3, accessors_.count(positions), Integers::any);
    if (!places) return places.issue();
    std::vector<SkinnedVertex> vertices(places->size() / 3);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      vertices[i].position = Vec3((*places)[3 * i], (*places)[3 * i + 1], (*places)[3 * i + 2]);
    for (std::size_t set = 0; set < kInfluences / 4; ++set)
      if (const auto bound = read_influences(set, vertices); !bound) return bound;
    for (SkinnedVertex& vertex : vertices) normalize(vertex);
    const std::size_t first = out.vertices.size();
    out.vertices.insert(out.vertices.end(), vertices.begin(), vertices.end());
    return read_triangles(first, vertices.size(), out);
  }

 private:
  int attribute(const std::string& name) const {
    const auto found = primitive_.attributes.find(name);
    return found == primitive_.attributes.end() ? -1 : found->second;
  }

  bool is_solid() const { return primitive_.mode < 0 || primitive_.mode >= TINYGLTF_MODE_TRIANGLES; }

  Result<Done> read_influences(std::size_t set, std::vector<SkinnedVertex>& vertices) {
    const int joints = attribute("JOINTS_" + std::to_string(set));
    const int weights = attribute("WEIGHTS_" + std::to_string(set));
    if (joints < 0 || weights < 0) return Done{};
    for (const int accessor : {joints, weights})
      if (accessors_.count(accessor) != vertices.size())
        return Issue{"gltf.bad_mesh", pointer_,
                     "found " + std::to_string(accessors_.count(accessor)) + " joints or weights for " +
                         std::to_string(vertices.size()) + " positions"};
    const auto numbers = accessors_.read_indices(joints, ElementKind::vec4);
    if (!numbers) return numbers.issue();
    const auto shares = accessors_.read(weights, ElementKind::vec4, vertices.size(), Integers::normalized);
    if (!shares) return shares.issue();
    for (std::size_t i = 0; i < 4 * vertices.size(); ++i) {
      const double weight = std::max((*shares)[i], 0.0);
      const auto joint = static_cast<std::size_t>((*numbers)[i]);
      if (weight > 0.0 && joint >= joint_count_)
        return Issue{"gltf.bad_index", pointer_,
                     "vertex " + std::to_string(i / 4) + " hangs on joint " + std::to_string(joint) +
                         " of a skin with " + std::to_string(joint_count_)};
      vertices[i / 4].joints[4 * set + i % 4] = weight > 0.0 ? static_cast<int>(joint) : 0;
      vertices[i / 4].weights[4 * set + i % 4] = weight;
    }
    return Done{};
  }

  static void normalize(SkinnedVertex& vertex) {
    double sum = 0.0;
    for (const double weight : vertex.weights) sum += weight;
    if (sum > 0.0)
      for (double& weight : vertex.weights) weight /= sum;
  }

  // Converts lists, strips and fans to triangles.
  Result<Done> read_triangles(std::size_t first, std::size_t count, SkinnedMesh& out) {
    std::vector<int> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<int>(i);
    if (primitive_.indices >= 0) {
      auto indices = accessors_.read_indices(primitive_.indices, ElementKind::scalar);
      if (!indices) return indices.issue();
      order = std::move(indices).value();
    }
    for (const int index : order)
      if (static_cast<std::size_t>(index) >= count)
        return Issue{"gltf.bad_index", pointer_ + "/indices",
                     "found " + std::to_string(index) + "; allowed is the index of one of " + std::to_string(count) +
                         " vertices"};
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      for (const std::size_t i : {a, b, c}) out.indices.push_back(static_cast<int>(first) + order[i]);
    };
    const bool is_list = primitive_.mode < 0 || primitive_.mode == TINYGLTF_MODE_TRIANGLES;
    for (std::size_t i = 0; i + 2 < order.size(); i += is_list ? 3 : 1) {
      if (primitive_.mode == TINYGLTF_MODE_TRIANGLE_FAN)
        add(0, i + 1, i + 2);
      else if (is_list || i % 2 == 0)
        add(i, i + 1, i + 2);
      else
        add(i + 1, i, i + 2);
    }
    return Done{};
  }

  const tinygltf::Primitive& primitive_;
  AccessorReader& accessors_;
  std::size_t joint_count_;
  std::string pointer_;
};

}  // namespace

Result<Done> read_meshes(const tinygltf::Model& model, AccessorReader& accessors, SkinnedAsset& asset) {
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    const tinygltf::Node& carrier = model.nodes[node];
    if (carrier.mesh < 0 || carrier.skin < 0) continue;
    SkinnedMesh mesh{static_cast<int>(node), carrier.skin, {}, {}};
    const std::size_t joints = asset.asset.skins[static_cast<std::size_t>(carrier.skin)].joints.size();
    const tinygltf::Mesh& source = model.meshes[static_cast<std::size_t>(carrier.mesh)];
    for (std::size_t i = 0; i < source.primitives.size(); ++i) {
      const std::string pointer = "/meshes/" + std::to_string(carrier.mesh) + "/primitives/" + std::to_string(i);
      if (const auto read = PrimitiveReader(source.primitives[i], accessors, joints, pointer).read(mesh); !read)
        return read.issue();
    }
    asset.meshes.push_back(std::move(mesh));
  }
  return Done{};
}

}  // namespace contort
