// A rigged model between file and character: the relevant joints, in metres, upright, facing +Z, with the vertices that
// each joint owns. Stages fill it one after another: skeleton.h, roles.h, then limits.h, fit.h, bodies.h and parts.h
// read it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/asset/skinned.h"
#include "model/character/desc.h"
#include "model/core/math.h"

namespace contort {

// The meaning of the words in a joint's name. The final role also depends on its place among the others.
enum class BoneFamily : std::uint8_t {
  unknown,
  hips,
  spine,
  neck,
  head,
  clavicle,
  upper_arm,
  forearm,
  arm,
  hand,
  finger,
  thigh,
  shank,
  leg,
  foot,
  toe,
  tail
};

enum class BoneRole : std::uint8_t {
  other,
  root,
  spine,
  neck,
  head,
  clavicle,
  upper_arm,
  forearm,
  hand,
  finger,
  thigh,
  shank,
  hock,
  foot,
  toe,
  tail
};

struct Bone {
  int node = 0;
  int parent = -1;    // an earlier bone; -1 for the first one, which is the root
  std::string label;  // the node's label in the file
  std::string name;   // a valid name, unique in the figure
  BoneFamily family = BoneFamily::unknown;
  bool from_vrm = false;  // family and side come from VRM's map
  Side side = Side::center;
  BoneRole role = BoneRole::other;
  Vec3 position_m{0.0};        // relative to the root
  std::vector<Vec3> points_m;  // evenly spread points of the bone's surface, relative to its position
};

struct RiggedFigure {
  std::vector<Bone> bones;              // parents first
  Quat world_from_model = kNoRotation;  // the rotation that makes the figure face +Z
  double metres_per_unit = 1.0;
  double height_m = 0.0;      // height of all vertices
  double ground_m = 0.0;      // height of the lowest vertex relative to the root
  bool is_humanoid = false;   // it has two arms and two legs of two bones each, and an upright spine
  bool is_quadruped = false;  // four legs on the ground
  int vertex_count = 0;
  std::vector<std::string> notes;  // guesses, for the report
};

struct ImportOptions {
  std::string name;              // the character's name, a valid one
  double metres_per_unit = 0.0;  // 0: guessed
  double height_m = 0.0;         // 0: follows from the scale
  int skin = -1;                 // index in the file; -1: the skin that most vertices follow
  bool draw_mesh = false;        // parts are drawn as the model's triangles
  bool wears_model = false;      // skins/NAME.json is written, for the model's copy skins/NAME.glb
};

inline const Bone& bone_at(const RiggedFigure& figure, int index) {
  return figure.bones[static_cast<std::size_t>(index)];
}
// Returns the children of a bone, in order.
std::vector<int> children_of(const RiggedFigure& figure, int bone);

}  // namespace contort
