#include "import/skeleton.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "import/names.h"
#include "import/skinning.h"
#include "model/core/index.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

constexpr std::size_t kMaxBones = 256;
constexpr double kSurfacePoints = 40000.0;  // of a figure
constexpr std::size_t kFewPoints = 40;      // of a bone
constexpr double kMaxCoordinate = 1e6;      // of vertices and joints, in the file's units

// ---- which skeleton

// Skins that share joints are one skeleton: by skin the first skin of its skeleton.
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
    return Issue{"import.no_skin", "/skins", "the file has no skin: nothing moves its meshes"};
  if (wanted_skin >= static_cast<int>(skeletons.size()))
    return Issue{"import.unknown_skin", "/skins",
                 "found --skin " + std::to_string(wanted_skin) + "; the file has " + std::to_string(skeletons.size())};
  std::vector<std::size_t> vertices(skeletons.size(), 0);
  for (const SkinnedMesh& mesh : asset.meshes) vertices[at(skeletons[at(mesh.skin)])] += mesh.vertices.size();
  const auto most = std::max_element(vertices.begin(), vertices.end());
  const int chosen = wanted_skin >= 0 ? skeletons[at(wanted_skin)] : static_cast<int>(most - vertices.begin());
  if (vertices[at(chosen)] == 0)
    return Issue{"import.no_vertices", "/meshes", "no vertex hangs on the skin: there is nothing to fit a body to"};
  return chosen;
}

// ---- bones

class FigureReader {
 public:
  FigureReader(const SkinnedAsset& asset, const ImportOptions& options)
      : asset_(asset), options_(options), world_(world_of(asset.asset)), owned_(asset.asset.nodes.size()) {}

  Result<RiggedFigure> read() {
    skeletons_ = skeletons_of(asset_.asset);
    const Result<int> chosen = choose_skeleton(asset_, skeletons_, options_.skin);
    if (!chosen) return chosen.issue();
    if (const Result<Done> placed = place_vertices(*chosen); !placed) return placed.issue();
    if (const Result<Done> kept = keep_bones(*chosen); !kept) return kept.issue();
    sense_bones();
    join_trees();
    trim_root();
    sort_bones();
    if (const Result<Done> scaled = to_metres(); !scaled) return scaled.issue();
    name_bones();
    return std::move(out_);
  }

 private:
  Result<Done> place_vertices(int skeleton) {
    std::vector<std::pair<const SkinnedMesh*, PlacedMesh>> meshes;
    double area = 0.0;
    for (const SkinnedMesh& mesh : asset_.meshes) {
      if (skeletons_[at(mesh.skin)] != skeleton) continue;
      meshes.emplace_back(&mesh, place(asset_, mesh, world_));
      for (const Vec3& p : meshes.back().second.positions)
        for (int c = 0; c < 3; ++c)
          if (!(std::fabs(p[c]) <= kMaxCoordinate))
            return Issue{"import.too_large", "/meshes", "a vertex lies more than 1e6 from the origin, or nowhere"};
      area += area_of(mesh, meshes.back().second);
    }
    std::vector<std::vector<Vec3>> vertices(owned_.size());
    for (const auto& [mesh, placed] : meshes) {
      for (std::size_t i = 0; i < placed.positions.size(); ++i)
        if (placed.owners[i] >= 0) vertices[at(placed.owners[i])].push_back(placed.positions[i]);
      if (!(area > 0.0)) continue;
      for (const SurfacePoint& p : spread_points(asset_, *mesh, placed, area / kSurfacePoints))
        if (p.owner >= 0) owned_[at(p.owner)].push_back(p.position);
    }
    take_vertices(vertices);
    if (out_.vertex_count > 0) return Done{};
    return Issue{"import.no_vertices", "/meshes", "no vertex hangs on the skin: there is nothing to fit a body to"};
  }

  // Small pieces have few points of the surface: these have their vertices too.
  void take_vertices(const std::vector<std::vector<Vec3>>& vertices) {
    for (std::size_t node = 0; node < vertices.size(); ++node) {
      out_.vertex_count += static_cast<int>(vertices[node].size());
      for (const Vec3& p : vertices[node]) low_ = glm::min(low_, p), high_ = glm::max(high_, p);
      if (owned_[node].size() < kFewPoints)
        owned_[node].insert(owned_[node].end(), vertices[node].begin(), vertices[node].end());
    }
  }

  // Joints that own vertices, and those that carry such.
  Result<Done> keep_bones(int skeleton) {
    const Asset& asset = asset_.asset;
    std::vector<char> is_joint(asset.nodes.size(), 0), keeps(asset.nodes.size(), 0);
    std::size_t joint_count = 0;
    for (std::size_t s = 0; s < asset.skins.size(); ++s)
      if (skeletons_[s] == skeleton)
        for (const int joint : asset.skins[s].joints) joint_count += is_joint[at(joint)] == 0, is_joint[at(joint)] = 1;
    for (auto node = asset.order.rbegin(); node != asset.order.rend(); ++node) {
      if (!owned_[at(*node)].empty()) keeps[at(*node)] = 1;
      if (const int parent = asset.nodes[at(*node)].parent; keeps[at(*node)] != 0 && parent >= 0) keeps[at(parent)] = 1;
    }
    std::vector<int> bone_of(asset.nodes.size(), -1);
    for (const int node : asset.order) {
      const int parent = asset.nodes[at(node)].parent;
      const int above = parent < 0 ? -1 : bone_of[at(parent)];
      bone_of[at(node)] = above;
      if (keeps[at(node)] == 0 || is_joint[at(node)] == 0) continue;
      bone_of[at(node)] = static_cast<int>(out_.bones.size());
      Bone bone;
      bone.node = node, bone.parent = above, bone.label = asset.nodes[at(node)].label;
      bone.position_m = Vec3(world_[at(node)][3]);
      bone.points_m = std::move(owned_[at(node)]);
      out_.bones.push_back(std::move(bone));
    }
    const std::size_t left_out = joint_count - out_.bones.size();
    if (left_out > 0) note(std::to_string(left_out) + " joints own no vertex and carry none that does: left out.");
    note_other_skeletons(skeleton);
    if (out_.bones.size() <= kMaxBones) return Done{};
    return Issue{"import.too_many_joints", "/skins",
                 "found " + std::to_string(out_.bones.size()) + " joints that move vertices, allowed are " +
                     std::to_string(kMaxBones)};
  }

  void note_other_skeletons(int skeleton) {
    const std::set<int> all(skeletons_.begin(), skeletons_.end());
    if (all.size() > 1)
      note("The file has " + std::to_string(all.size()) + " skeletons; this is the one of skin " +
           std::to_string(skeleton) + ", and --skin chooses another.");
  }

  void sense_bones() {
    std::map<int, std::string> vrm;
    for (const auto& [bone, node] : asset_.humanoid) vrm[node] = bone;
    for (Bone& bone : out_.bones) {
      const auto known = vrm.find(bone.node);
      bone.from_vrm = known != vrm.end();
      const NameSense sense =
          bone.from_vrm ? sense_of_vrm(known->second) : sense_of(asset_.asset.nodes[at(bone.node)].name);
      bone.family = sense.family, bone.side = sense.side;
    }
    if (!vrm.empty()) note("The file has a VRM map of a person's bones, which goes before names.");
  }

  // ---- one tree

  std::size_t subtree_vertices(int root) const {
    std::size_t sum = 0;
    for (std::size_t b = 0; b < out_.bones.size(); ++b) {
      int up = static_cast<int>(b);
      while (up >= 0 && up != root) up = bone_at(out_, up).parent;
      if (up == root) sum += out_.bones[b].points_m.size();
    }
    return sum;
  }

  bool is_leg(const Bone& bone) const {
    return bone.family == BoneFamily::thigh || bone.family == BoneFamily::shank || bone.family == BoneFamily::leg;
  }

  // The end of a leg of that side that is nearest, one without a foot before others; -1 where there is none.
  int leg_for(const Bone& foot) const {
    int best = -1;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < out_.bones.size(); ++b) {
      const Bone& leg = out_.bones[b];
      if (!is_leg(leg) || leg.side != foot.side) continue;
      bool ends = true, has_foot = false;
      for (const int c : children_of(out_, static_cast<int>(b)))
        ends = ends && !is_leg(bone_at(out_, c)), has_foot = has_foot || bone_at(out_, c).family == BoneFamily::foot;
      const double distance = length(leg.position_m - foot.position_m) + (has_foot ? kMaxCoordinate : 0.0);
      if (ends && distance < nearest) nearest = distance, best = static_cast<int>(b);
    }
    return best;
  }

  bool hangs_on_leg(int bone) const {
    for (int b = bone_at(out_, bone).parent; b >= 0; b = bone_at(out_, b).parent)
      if (is_leg(bone_at(out_, b))) return true;
    return false;
  }

  void join_trees() {
    for (std::size_t b = 0; b < out_.bones.size(); ++b) {
      Bone& bone = out_.bones[b];
      const bool is_foot = bone.family == BoneFamily::foot && bone.side != Side::center;
      if (!is_foot || hangs_on_leg(static_cast<int>(b))) continue;
      const int leg = leg_for(bone);
      if (leg < 0) continue;
      bone.parent = leg;
      note("\"" + bone.label + "\" hangs on no leg in the file; here it hangs on \"" + bone_at(out_, leg).label +
           "\".");
    }
    root_ = -1;
    std::size_t most = 0;
    for (std::size_t b = 0; b < out_.bones.size(); ++b)
      if (out_.bones[b].parent < 0)
        if (const std::size_t count = subtree_vertices(static_cast<int>(b)); root_ < 0 || count > most)
          root_ = static_cast<int>(b), most = count;
    for (std::size_t b = 0; b < out_.bones.size(); ++b) {
      if (out_.bones[b].parent >= 0 || static_cast<int>(b) == root_) continue;
      out_.bones[b].parent = root_;
      note("\"" + out_.bones[b].label + "\" has no parent in the file; here it hangs on the root.");
    }
  }

  // A root that owns nothing and carries one joint is a handle.
  void trim_root() {
    for (;;) {
      const std::vector<int> below = children_of(out_, root_);
      if (!bone_at(out_, root_).points_m.empty() || below.size() != 1) return;
      out_.bones[at(root_)].parent = -2;  // taken out by sort_bones
      root_ = below.front();
      out_.bones[at(root_)].parent = -1;
    }
  }

  void sort_bones() {
    std::vector<int> order, open = {root_}, place(out_.bones.size(), -1);
    while (!open.empty()) {
      const int bone = open.back();
      open.pop_back();
      place[at(bone)] = static_cast<int>(order.size());
      order.push_back(bone);
      const std::vector<int> below = children_of(out_, bone);
      open.insert(open.end(), below.rbegin(), below.rend());
    }
    std::vector<Bone> sorted;
    for (const int bone : order) sorted.push_back(std::move(out_.bones[at(bone)]));
    for (Bone& bone : sorted)
      if (bone.parent >= 0) bone.parent = place[at(bone.parent)];
    sorted.front().parent = -1;
    out_.bones = std::move(sorted);
  }

  // ---- metres, facing +Z

  // From the figure's right to its left, level; 0 where no names tell.
  Vec3 to_left() const {
    Vec3 sum(0.0);
    int left = 0, right = 0;
    for (const Bone& bone : out_.bones) {
      left += bone.side == Side::left, right += bone.side == Side::right;
      if (bone.side != Side::center) sum += (bone.side == Side::left ? 1.0 : -1.0) * bone.position_m;
    }
    return left == right && left > 0 ? Vec3(sum.x, 0.0, sum.z) : Vec3(0.0);
  }

  // A multiple of a quarter turn: models stand along the axes.
  Quat facing(double size) {
    const Vec3 left = to_left();
    if (length(left) < 1e-3 * size) {
      note("No names tell left from right: taken to face +Z, as glTF has it.");
      return kNoRotation;
    }
    if (std::fabs(left.x) >= std::fabs(left.z)) {
      if (left.x > 0.0) return kNoRotation;
      note("The model faces -Z: turned by half a turn.");
      return {0.0, 0.0, 1.0, 0.0};
    }
    note("The model stands sideways: turned by a quarter.");
    const double half = std::sqrt(0.5);
    return {half, 0.0, left.z > 0.0 ? half : -half, 0.0};
  }

  double scale_of(const Vec3& size) {
    const double largest = std::max({size.x, size.y, size.z});
    if (options_.metres_per_unit > 0.0) return options_.metres_per_unit;
    if (options_.height_m > 0.0) return options_.height_m / std::max(size.y, 1e-6 * largest);
    double scale = 1.0;
    if (largest >= 0.2 && largest <= 30.0) return scale;
    while (largest * scale > 5.0) scale /= 10.0;
    while (largest * scale < 0.5) scale *= 10.0;
    note("The model's largest side is " + number_text(largest) + " units, which are hardly metres: scaled by " +
         number_text(scale) + ". --scale or --height-m says it better.");
    return scale;
  }

  Result<Done> to_metres() {
    const Vec3 size = high_ - low_;
    const double largest = std::max({size.x, size.y, size.z});
    if (!(largest > 1e-9)) return Issue{"import.flat", "/meshes", "all vertices lie in one point"};
    const double scale = scale_of(size);
    if (!(scale * largest <= 90.0))
      return Issue{"import.too_large", "", "the figure would be larger than 90 m; --scale and --height-m change that"};
    out_.metres_per_unit = scale;
    out_.world_from_model = facing(largest);
    out_.height_m = scale * size.y;
    out_.ground_m = scale * (low_.y - out_.bones.front().position_m.y);
    const Vec3 origin = out_.bones.front().position_m;
    for (Bone& bone : out_.bones) {
      for (Vec3& p : bone.points_m) p = out_.world_from_model * (scale * (p - bone.position_m));
      bone.position_m = out_.world_from_model * (scale * (bone.position_m - origin));
      for (int i = 0; i < 3; ++i) {
        if (!(std::fabs(bone.position_m[i]) <= 90.0))
          return Issue{"import.too_large", "/nodes/" + std::to_string(bone.node), "the joint lies 90 m from the root"};
        bone.position_m[i] = on_lattice(bone.position_m[i], 1e5);
      }
    }
    return Done{};
  }

  void name_bones() {
    std::set<std::string> taken;
    for (Bone& bone : out_.bones)
      bone.name = claim_name(legal_name(bone.label, "joint_" + std::to_string(bone.node)), taken);
  }

  void note(std::string text) { out_.notes.push_back(std::move(text)); }

  const SkinnedAsset& asset_;
  const ImportOptions& options_;
  std::vector<Mat4> world_;
  std::vector<std::vector<Vec3>> owned_;  // by node: points of the surface, in the file's units
  std::vector<int> skeletons_;
  Vec3 low_{std::numeric_limits<double>::infinity()};  // of all vertices
  Vec3 high_{-std::numeric_limits<double>::infinity()};
  int root_ = 0;
  RiggedFigure out_;
};

}  // namespace

std::vector<int> children_of(const RiggedFigure& figure, int bone) {
  std::vector<int> out;
  for (std::size_t b = 0; b < figure.bones.size(); ++b)
    if (figure.bones[b].parent == bone) out.push_back(static_cast<int>(b));
  return out;
}

Result<RiggedFigure> read_figure(const SkinnedAsset& asset, const ImportOptions& options) {
  return FigureReader(asset, options).read();
}

}  // namespace contort
