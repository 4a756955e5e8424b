#include <algorithm>

#include "import/limits.h"
#include "model/asset/sample.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr int kMostPoses = 2400;
constexpr int kMostPerClip = 120;

// The rotation of every node in the world. Scales do not affect it.
std::vector<Quat> world_turns(const Asset& asset, const std::vector<Trs>& local) {
  std::vector<Quat> world(asset.nodes.size(), kNoRotation);
  for (const int node : asset.order) {
    const int parent = asset.nodes[at(node)].parent;
    world[at(node)] = parent < 0 ? local[at(node)].rotation : world[at(parent)] * local[at(node)].rotation;
  }
  return world;
}

}  // namespace

ClipPoses sample_clips(const Asset& asset, const RiggedFigure& figure) {
  ClipPoses out;
  out.turns.resize(figure.bones.size());
  std::vector<Trs> local;
  for (const AssetNode& node : asset.nodes) local.push_back(node.rest);
  const std::vector<Quat> rest = world_turns(asset, local);
  const int clips = static_cast<int>(asset.clips.size());
  const int per_clip = clips == 0 ? 0 : std::clamp(kMostPoses / clips, 2, kMostPerClip);
  const Quat& q = figure.world_from_model;
  for (int c = 0; c < std::min(clips, kMostPoses / 2); ++c)
    for (int i = 0; i < per_clip; ++i) {
      const AssetClip& clip = asset.clips[at(c)];
      const double t_s = clip.first_s + (clip.last_s - clip.first_s) * i / (per_clip - 1);
      const std::vector<Quat> now = world_turns(asset, pose(asset, clip, t_s));
      std::vector<Quat> turned;
      for (const Bone& bone : figure.bones) {
        turned.push_back(q * now[at(bone.node)] * glm::conjugate(rest[at(bone.node)]) * glm::conjugate(q));
        const Quat carrier = bone.parent < 0 ? kNoRotation : turned[at(bone.parent)];
        out.turns[turned.size() - 1].push_back(glm::conjugate(carrier) * turned.back());
      }
      ++out.pose_count;
    }
  return out;
}

RiggedFigure mirrored(RiggedFigure figure) {
  for (Bone& bone : figure.bones) {
    bone.position_m = mirror_point(bone.position_m);
    for (Vec3& p : bone.points_m) p = mirror_point(p);
    if (bone.side != Side::center) bone.side = bone.side == Side::left ? Side::right : Side::left;
  }
  return figure;
}

ClipPoses mirrored(ClipPoses poses) {
  for (std::vector<Quat>& turns : poses.turns)
    for (Quat& q : turns) q = mirror_rotation(q);
  return poses;
}

}  // namespace contort
