#include "guest/model_joints.h"

#include <algorithm>

#include "guest/manifest_check.h"
#include "model/core/index.h"
#include "model/core/json_value_fields.h"
#include "model/core/nearest.h"

namespace contort {

namespace {

constexpr std::size_t kMostNamed = 12;  // greatest number of joints in a message

Quat quat_of(const std::array<double, 4>& q) { return {q[3], q[0], q[1], q[2]}; }
std::array<double, 4> numbers_of_rotation(const Quat& q) { return {q.x, q.y, q.z, q.w}; }

// Positions are in the file's unit of length.
std::vector<Rigid> places_at_rest(const GuestCharacter& character) {
  std::vector<Rigid> world;
  for (const GuestJoint& joint : character.joints) {
    const Rigid local{quat_of(joint.rotation), joint.position};
    const int parent = find_joint(character, joint.parent);
    world.push_back(parent < 0 ? local : world[at(parent)] * local);
  }
  return world;
}

Issue unknown_joint(const GuestCharacter& from, const std::string& name, std::size_t index) {
  std::vector<std::string> all;
  std::string some;
  for (const GuestJoint& joint : from.joints) {
    if (all.size() < kMostNamed) some += (all.empty() ? "" : ", ") + joint.name;
    all.push_back(joint.name);
  }
  if (all.size() > kMostNamed) some += " and " + std::to_string(all.size() - kMostNamed) + " more";
  const std::string meant = nearest(name, all);
  return {"generator.unknown_joint", "/joints/" + std::to_string(index) + "/name",
          json_fields::quoted(name) + " is no joint of the model, which has " + some +
              (meant.empty() ? "" : "; did you mean " + json_fields::quoted(meant) + "?")};
}

// The joints of a model, and the chosen ones among them.
class Chosen {
 public:
  Chosen(const GuestCharacter& from, std::span<const std::string> names)
      : from_(from), world_(places_at_rest(from)), is_taken_(from.joints.size(), 0) {
    for (const std::string& name : names)
      if (const int j = find_joint(from, name); j >= 0) is_taken_[at(j)] = 1;
  }

  // The nearest chosen joint from this one on towards the root; -1 if there is none.
  int taken_from(int joint) const {
    while (joint >= 0 && is_taken_[at(joint)] == 0) joint = find_joint(from_, from_.joints[at(joint)].parent);
    return joint;
  }

  GuestJoint joint(int index) const {
    GuestJoint out = from_.joints[at(index)];
    const int parent = taken_from(find_joint(from_, out.parent));
    const Rigid place = parent < 0 ? world_[at(index)] : inverse(world_[at(parent)]) * world_[at(index)];
    out.parent = parent < 0 ? "" : from_.joints[at(parent)].name;
    out.position = place.p_m, out.rotation = numbers_of_rotation(place.q);
    if (out.follows && !is_taken(out.follows->joint)) out.follows.reset();
    return out;
  }

  // Moves a collider to the nearest chosen joint that carries it, or to the first one.
  GuestCollider collider(GuestCollider shape, int first) const {
    const int own = find_joint(from_, shape.joint), taken = taken_from(own), carrier = taken < 0 ? first : taken;
    const Rigid moved = inverse(world_[at(carrier)]) * world_[at(own)];
    shape.joint = from_.joints[at(carrier)].name;
    shape.from = moved * shape.from, shape.to = moved * shape.to, shape.center = moved * shape.center;
    shape.rotation = numbers_of_rotation(moved.q * quat_of(shape.rotation));
    return shape;
  }

 private:
  bool is_taken(const std::string& name) const {
    const int joint = find_joint(from_, name);
    return joint >= 0 && is_taken_[at(joint)] != 0;
  }

  const GuestCharacter& from_;
  std::vector<Rigid> world_;
  std::vector<char> is_taken_;
};

}  // namespace

Result<GuestCharacter> with_joints(const GuestCharacter& from, std::span<const std::string> names) {
  const Chosen chosen(from, names);
  GuestCharacter out = from;
  out.joints.clear(), out.colliders.clear();
  for (std::size_t n = 0; n < names.size(); ++n) {
    const int index = find_joint(from, names[n]);
    if (index < 0) return unknown_joint(from, names[n], n);
    out.joints.push_back(chosen.joint(index));
  }
  const int first = find_joint(from, names.front());
  for (const GuestCollider& collider : from.colliders) out.colliders.push_back(chosen.collider(collider, first));
  return out;
}

}  // namespace contort
