#include "import/skeleton.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "import/bone_tree.h"
#include "import/metres.h"
#include "import/names.h"
#include "import/owned_surface.h"
#include "import/skinning.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr std::size_t kMaxBones = 256;

// ---- which skeleton

// Skins that share joints belong to one skeleton. Returns, for each skin, the first skin of its skeleton.
std::vector<int> skeletons_of(const Asset& asset) {
  std::vector<int> first(asset.skins.size());
  std::vector<int> skin_of_node(asset.nodes.size(), -1);
  const auto find = [&](int skin) {
    while (first[at(skin)] != skin) skin = first[at(skin)] = first[at(first[at(skin)])];
    return skin;
  };
  for (int s = 0; s < static_cast<int>(asset.skins.size()); ++s) {
    first[at(s)] = s;
    for (const int joint : asset.skins[at(s)].joints) {
      int& known = skin_of_node[at(joint)];
      if (known < 0) known = s;
      const int a = find(known), b = find(s);
      first[at(std::max(a, b))] = std::min(a, b);
    }
  }
  for (int s = 0; s < static_cast<int>(first.size()); ++s) first[at(s)] = find(s);
  return first;
}

Result<int> choose_skeleton(const SkinnedAsset& asset, const std::vector<int>& skeletons, int wanted_skin) {
  if (asset.asset.skins.empty())
    return Issue{"import.no_skin", "/skins", "the file has no skin (mesh bound to joints), so it cannot be imported; contort check can still judge its clips"};
  if (wanted_skin >= static_cast<int>(skeletons.size()))
    return Issue{"import.unknown_skin", "/skins",
                 "found --skin " + std::to_string(wanted_skin) + "; the file has " + std::to_string(skeletons.size())};
  std::vector<std::size_t> vertices(skeletons.size(), 0);
  for (const SkinnedMesh& mesh : asset.meshes) vertices[at(skeletons[at(mesh.skin)])] += mesh.vertices.size();
  const auto most = std::max_element(vertices.begin(), vertices.end());
  const int chosen = wanted_skin >= 0 ? skeletons[at(wanted_skin)] : static_cast<int>(most - vertices.begin());
  if (vertices[at(chosen)] == 0)
    return Issue{"import.no_vertices", "/meshes", "no vertex follows the skin, so there is no surface to fit bodies to"};
  return chosen;
}

// ---- bones

std::vector<char> joints_of(const Asset& asset, const std::vector<int>& skeletons, int skeleton) {
  std::vector<char> is_joint(asset.nodes.size(), 0);
  for (std::size_t s = 0; s < asset.skins.size(); ++s)
    if (skeletons[s] == skeleton)
      for (const int joint : asset.skins[s].joints) is_joint[at(joint)] = 1;
  return is_joint;
}

// Marks nodes with points, and all nodes above them.
std::vector<char> carriers(const Asset& asset, const OwnedSurface& surface) {
  std::vector<char> carries(asset.nodes.size(), 0);
  for (auto node = asset.order.rbegin(); node != asset.order.rend(); ++node) {
    if (!surface.points[at(*node)].empty()) carries[at(*node)] = 1;
    const int parent = asset.nodes[at(*node)].parent;
    if (carries[at(*node)] != 0 && parent >= 0) carries[at(parent)] = 1;
  }
  return carries;
}

// The kept nodes as bones. Each is the child of its nearest kept ancestor.
std::vector<Bone> bones_of(const Asset& asset, const std::vector<char>& keeps) {
  std::vector<Bone> bones;
  std::vector<int> bone_of(asset.nodes.size(), -1);
  for (const int node : asset.order) {
    const int parent = asset.nodes[at(node)].parent;
    const int above = parent < 0 ? -1 : bone_of[at(parent)];
    bone_of[at(node)] = above;
    if (keeps[at(node)] == 0) continue;
    bone_of[at(node)] = static_cast<int>(bones.size());
    Bone bone;
    bone.node = node, bone.parent = above, bone.label = asset.nodes[at(node)].label;
    bones.push_back(std::move(bone));
  }
  return bones;
}

void note_left_out(RiggedFigure& figure, std::size_t count) {
  if (count > 0)
    figure.notes.push_back(std::to_string(count) + " joints own no vertex and carry none that does: left out.");
}

void note_other_skeletons(RiggedFigure& figure, const std::vector<int>& skeletons, int skeleton) {
  const std::set<int> all(skeletons.begin(), skeletons.end());
  if (all.size() > 1)
    figure.notes.push_back("The file has " + std::to_string(all.size()) + " skeletons; this is the one of skin " +
                           std::to_string(skeleton) + ", and --skin chooses another.");
}

// Keeps the joints with points, and all joints above them, in the file's units.
RiggedFigure keep_bones(const Asset& asset, const std::vector<int>& skeletons, int skeleton,
                        const std::vector<Mat4>& world, OwnedSurface surface) {
  const std::vector<char> is_joint = joints_of(asset, skeletons, skeleton);
  std::vector<char> keeps = carriers(asset, surface);
  for (std::size_t node = 0; node < keeps.size(); ++node) keeps[node] = keeps[node] != 0 && is_joint[node] != 0;
  RiggedFigure figure;
  figure.vertex_count = surface.vertex_count;
  figure.bones = bones_of(asset, keeps);
  for (Bone& bone : figure.bones) {
    bone.position_m = Vec3(world[at(bone.node)][3]);
    bone.points_m = std::move(surface.points[at(bone.node)]);
  }
  note_left_out(figure, static_cast<std::size_t>(std::ranges::count(is_joint, 1)) - figure.bones.size());
  note_other_skeletons(figure, skeletons, skeleton);
  return figure;
}

Result<Done> check_bone_count(std::size_t count) {
  if (count <= kMaxBones) return Done{};
  return Issue{"import.too_many_joints", "/skins",
               "found " + std::to_string(count) + " joints that move vertices, allowed are " +
                   std::to_string(kMaxBones)};
}

void sense_bones(const SkinnedAsset& asset, RiggedFigure& figure) {
  std::map<int, std::string> vrm;
  for (const auto& [bone, node] : asset.humanoid) vrm[node] = bone;
  for (Bone& bone : figure.bones) {
    const auto known = vrm.find(bone.node);
    bone.from_vrm = known != vrm.end();
    const NameSense sense =
        bone.from_vrm ? sense_of_vrm(known->second) : sense_of(asset.asset.nodes[at(bone.node)].name);
    bone.family = sense.family, bone.side = sense.side;
  }
  if (!vrm.empty()) figure.notes.push_back("The file has a VRM map of a person's bones, which goes before names.");
}

void name_bones(RiggedFigure& figure) {
  std::set<std::string> taken;
  for (Bone& bone : figure.bones)
    bone.name = claim_name(legal_name(bone.label, "joint_" + std::to_string(bone.node)), taken);
}

}  // namespace

Result<RiggedFigure> read_figure(const SkinnedAsset& asset, const ImportOptions& options) {
  const std::vector<Mat4> world = world_of(asset.asset);
  const std::vector<int> skeletons = skeletons_of(asset.asset);
  const Result<int> chosen = choose_skeleton(asset, skeletons, options.skin);
  if (!chosen) return chosen.issue();
  Result<OwnedSurface> surface = surface_of(asset, skeletons, *chosen, world);
  if (!surface) return surface.issue();
  const ModelBox box = surface->box;
  RiggedFigure figure = keep_bones(asset.asset, skeletons, *chosen, world, std::move(surface).value());
  if (const Result<Done> fits = check_bone_count(figure.bones.size()); !fits) return fits.issue();
  sense_bones(asset, figure);
  make_one_tree(figure);
  if (const Result<Done> scaled = to_metres(figure, box, options); !scaled) return scaled.issue();
  name_bones(figure);
  return figure;
}

}  // namespace contort
