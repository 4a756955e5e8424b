#include "cli/bone_joints.h"

#include <algorithm>

#include "guest/described.h"
#include "guest/manifest_check.h"
#include "import/skinning.h"
#include "model/core/index.h"

namespace contort::cli {

namespace {

std::array<double, 4> xyzw(const Quat& q) { return {q.x, q.y, q.z, q.w}; }

// The place of each node at rest in the world, in the file's unit. Scales move the children of a node, but do not
// rotate them.
std::vector<Rigid> node_places(const Asset& asset) {
  const std::vector<Mat4> world = world_of(asset);
  std::vector<Rigid> places(asset.nodes.size());
  for (const int node : asset.order) {
    const AssetNode& from = asset.nodes[at(node)];
    const Quat above = from.parent < 0 ? kNoRotation : places[at(from.parent)].q;
    places[at(node)] = {above * from.rest.rotation, Vec3(world[at(node)][3])};
  }
  return places;
}

Result<Character> built(const CutFigure& cut) {
  Library library;
  for (const PartDesc& part : cut.parts) library.parts[part.name] = part;
  library.characters[cut.character.name] = cut.character;
  return build_character({cut.character.name, {}, {}}, library);
}

// Converts joints. Those of the import have the figure's axes at rest and metres; those of a guest have the axes of
// their nodes and the file's unit.
class BoneJoints {
 public:
  BoneJoints(const Asset& asset, const Imported& imported, const GuestCharacter& figure)
      : imported_(imported), figure_(figure), places_(node_places(asset)) {}

  GuestCharacter character() const {
    GuestCharacter out;
    for (std::size_t b = 0; b < bones().size(); ++b) out.joints.push_back(joint(b));
    for (const GuestCollider& shape : figure_.colliders)
      if (const int bone = bone_of(shape.joint); bone >= 0) out.colliders.push_back(collider(shape, at(bone)));
    for (const auto& [a, b] : figure_.may_touch)
      if (find_collider(out, a) >= 0 && find_collider(out, b) >= 0) out.may_touch.push_back({a, b});
    return out;
  }

 private:
  const std::vector<Bone>& bones() const { return imported_.figure.bones; }
  const BoneReport& report(std::size_t bone) const { return imported_.cut.bones[bone]; }
  const Rigid& place(std::size_t bone) const { return places_[at(bones()[bone].node)]; }
  Quat node_from_figure(std::size_t bone) const {
    return glm::conjugate(place(bone).q) * glm::conjugate(imported_.figure.world_from_model);
  }

  int bone_of(const std::string& joint) const {
    if (joint == "root") return 0;
    for (std::size_t b = 1; b < bones().size(); ++b)
      if (report(b).joint == joint || report(b).carries == joint) return static_cast<int>(b);
    return -1;
  }

  GuestJoint joint(std::size_t b) const {
    const int known = b == 0 ? 0 : find_joint(figure_, report(b).joint);
    GuestJoint out = known < 0 ? GuestJoint{} : figure_.joints[at(known)];
    const bool is_pair = b > 0 && report(b).carries != report(b).joint;
    if (is_pair) {
      GuestJoint free;
      free.slot = out.slot, free.max_speed_deg_s = out.max_speed_deg_s;
      out = free;
    }
    turn_limits(node_from_figure(b), out);
    out.name = bones()[b].label, out.body.clear();
    const int parent = bones()[b].parent;
    const Rigid rest = parent < 0 ? place(b) : inverse(place(at(parent))) * place(b);
    out.parent = parent < 0 ? "" : bones()[at(parent)].label;
    out.position = rest.p_m, out.rotation = xyzw(rest.q);
    return out;
  }

  // A range must contain the rest pose, which is 0.
  static void turn_limits(const Quat& turn, GuestJoint& joint) {
    joint.axis = turn * joint.axis;
    if (joint.swing_axis) joint.swing_axis = turn * *joint.swing_axis;
    joint.swing_center_deg = turn * joint.swing_center_deg;
    joint.low_deg = std::min(joint.low_deg, 0.0), joint.high_deg = std::max(joint.high_deg, 0.0);
  }

  GuestCollider collider(GuestCollider shape, std::size_t bone) const {
    const Quat turn = node_from_figure(bone);
    const double unit = 1.0 / imported_.figure.metres_per_unit;
    for (Vec3* point : {&shape.from, &shape.to, &shape.center}) *point = turn * (unit * *point);
    shape.radius *= unit, shape.half *= unit;
    const auto& [x, y, z, w] = shape.rotation;
    shape.rotation = xyzw(turn * Quat(w, x, y, z));
    shape.joint = bones()[bone].label;
    return shape;
  }

  const Imported& imported_;
  const GuestCharacter& figure_;
  std::vector<Rigid> places_;
};

}  // namespace

Result<GuestCharacter> joints_of_bones(const Asset& asset, const Imported& imported) {
  const Result<Character> character = built(imported.cut);
  if (!character) return character.issue();
  const GuestCharacter figure = describe(*character);
  return BoneJoints(asset, imported, figure).character();
}

}  // namespace contort::cli
