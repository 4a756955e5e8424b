#include "guest/guest_figure.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "guest/basis.h"
#include "guest/manifest_check.h"
#include "model/core/index.h"
#include "model/geometry/distance.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr std::size_t kLongestName = 40;     // greatest length of a joint's name
constexpr double kBoneThickness = 0.08;      // radius of a drawn bone, as a fraction of its length
constexpr double kFixed_deg = 0.01;          // half the range of a fixed joint, because a range needs two ends
constexpr double kEndless_deg = 1e5;
constexpr double kShortestBone_m = 1e-4;
constexpr double kEndRadius_m = 0.01;        // radius of the ball that is drawn for a joint without children

std::string legal_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_digit = c >= '0' && c <= '9';
    const char low = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    out += is_letter || is_digit ? low : '_';
  }
  return out.empty() ? "joint" : out.substr(0, kLongestName);
}

// The joint's name without its slot: a joint may be named "slot/joint".
std::string own_name(const std::string& name, const std::string& slot) {
  return legal_name(name.starts_with(slot + "/") ? name.substr(slot.size() + 1) : name);
}

// Adds numbers to repeated names.
std::vector<std::string> unique_names(const std::vector<std::string>& names) {
  std::vector<std::string> unique;
  std::set<std::string> taken;
  for (const std::string& wanted : names) {
    std::string name = wanted;
    for (int n = 2; !taken.insert(name).second; ++n) name = wanted + "_" + std::to_string(n);
    unique.push_back(name);
  }
  return unique;
}

std::vector<std::string> collider_names(const GuestCharacter& character) {
  const std::vector<std::string> slots = slots_of(character);
  std::vector<std::string> names;
  for (const GuestCollider& collider : character.colliders)
    names.push_back(own_name(collider.name, slots[at(find_joint(character, collider.joint))]));
  return unique_names(names);
}

// The data of a character while it is converted to our library.
struct GuestFigure {
  const GuestCharacter& from;
  const Basis basis;
  const std::vector<std::string> names;
  const std::vector<std::string> slots;

  int parent(std::size_t j) const { return find_joint(from, from.joints[j].parent); }
  bool begins_slot(std::size_t j) const { return j > 0 && slots[at(parent(j))] != slots[j]; }
  // The joint's name in its part; "" for the root body.
  std::string local_name(std::size_t j) const { return j == 0 ? "" : names[j]; }
};

// A hinge with a range of a full turn or more has no limits; its angle may count several turns.
void set_range(const GuestJoint& joint, JointDesc& out) {
  const bool is_endless = joint.type == GuestJointType::hinge && joint.high_deg - joint.low_deg >= 360.0;
  const bool is_fixed = joint.type == GuestJointType::fixed || joint.low_deg == joint.high_deg;
  out.low_deg = is_fixed ? -kFixed_deg : is_endless ? -kEndless_deg : joint.low_deg;
  out.high_deg = is_fixed ? kFixed_deg : is_endless ? kEndless_deg : joint.high_deg;
}

JointDesc joint_desc(const GuestFigure& figure, std::size_t j) {
  const GuestJoint& joint = figure.from.joints[j];
  JointDesc out;
  out.name = figure.names[j];
  out.parent = figure.begins_slot(j) ? "" : figure.local_name(at(figure.parent(j)));
  out.type = joint.type == GuestJointType::ball ? JointType::ball : JointType::hinge;
  if (!joint.body.empty()) out.body = legal_name(joint.body);
  out.position_m = figure.basis.point_m(joint.position);
  const auto& [x, y, z, w] = joint.rotation;
  out.rotation_deg = to_rotation_vector(normalize(figure.basis.rotation(x, y, z, w))) * kDegPerRad;
  out.axis = glm::normalize(figure.basis.axis(joint.axis));
  set_range(joint, out);
  if (out.type == JointType::ball) {
    out.swing_axis = joint.swing_axis ? glm::normalize(figure.basis.axis(*joint.swing_axis)) : perpendicular(out.axis);
    out.swing_deg = as_two(joint.swing_deg);
    out.swing_center_deg = figure.basis.axis(joint.swing_center_deg);
  }
  out.max_speed_deg_s = joint.max_speed_deg_s;
  return out;
}

MeshDesc bone_mesh(const std::string& joint, const Vec3& to_m) {
  const double long_m = length(to_m);
  if (long_m < kShortestBone_m) return {joint, Sphere{Vec3(0.0), kEndRadius_m}, Vec3(0.7)};
  return {joint, Capsule{Vec3(0.0), to_m, kBoneThickness * long_m}, Vec3(0.7)};
}

// Bones from each joint of the slot to its child joints, and balls at the ends.
std::vector<MeshDesc> bones_of(const GuestFigure& figure, const std::string& slot) {
  std::vector<MeshDesc> mesh;
  for (std::size_t j = 0; j < figure.names.size(); ++j) {
    if (figure.slots[j] != slot) continue;
    bool carries = false;
    for (std::size_t child = j + 1; child < figure.names.size(); ++child)
      if (figure.parent(child) == static_cast<int>(j)) {
        carries = true;
        mesh.push_back(bone_mesh(figure.local_name(j), figure.basis.point_m(figure.from.joints[child].position)));
      }
    if (!carries) mesh.push_back(bone_mesh(figure.local_name(j), Vec3(0.0)));
  }
  return mesh;
}

// Half sizes along our axes, which are the generator's in another order.
Vec3 half_m(const Vec3& half, const Basis& basis) { return glm::abs(basis.point_m(half)); }

ColliderShape shape_of(const GuestCollider& collider, const Basis& basis) {
  if (collider.type == GuestShape::capsule)
    return Capsule{basis.point_m(collider.from), basis.point_m(collider.to), basis.unit_m() * collider.radius};
  const auto& [x, y, z, w] = collider.rotation;
  return Box{basis.point_m(collider.center), half_m(collider.half, basis),
             to_rotation_vector(normalize(basis.rotation(x, y, z, w))) * kDegPerRad};
}

std::vector<ColliderDesc> colliders_of(const GuestFigure& figure, const std::string& slot) {
  std::vector<ColliderDesc> out;
  const std::vector<std::string> names = collider_names(figure.from);
  for (std::size_t c = 0; c < names.size(); ++c) {
    const GuestCollider& collider = figure.from.colliders[c];
    const std::size_t j = at(find_joint(figure.from, collider.joint));
    if (figure.slots[j] == slot) out.push_back({names[c], figure.local_name(j), shape_of(collider, figure.basis)});
  }
  return out;
}

// A socket on each joint. Other slots are attached to them, and goals refer to them.
std::vector<SocketDesc> sockets_of(const GuestFigure& figure, const std::string& slot) {
  std::vector<SocketDesc> sockets;
  for (std::size_t j = 0; j < figure.names.size(); ++j)
    if (figure.slots[j] == slot) sockets.push_back({figure.names[j], figure.local_name(j)});
  return sockets;
}

PartDesc part_desc(const GuestFigure& figure, const std::string& slot, const std::string& name) {
  PartDesc part;
  part.name = name;
  part.kind = figure.from.name + "_" + slot;
  for (std::size_t j = 1; j < figure.names.size(); ++j)
    if (figure.slots[j] == slot) part.joints.push_back(joint_desc(figure, j));
  part.colliders = colliders_of(figure, slot);
  part.sockets = sockets_of(figure, slot);
  if (figure.from.colliders.empty()) part.mesh = bones_of(figure, slot);
  return part;
}

SlotDesc slot_desc(const GuestFigure& figure, std::size_t first_joint) {
  SlotDesc slot;
  slot.name = figure.slots[first_joint];
  slot.kind = figure.from.name + "_" + slot.name;
  if (first_joint > 0) {
    slot.on_slot = figure.slots[at(figure.parent(first_joint))];
    slot.on_socket = figure.names[at(figure.parent(first_joint))];
  }
  const auto parts = figure.from.parts.find(slot.name);
  const std::size_t count = parts == figure.from.parts.end() ? 1 : parts->second.size();
  for (std::size_t i = 0; i < count; ++i) slot.parts.push_back(part_name(figure.from, slot.name, i));
  return slot;
}

std::string full_name(const GuestFigure& figure, const std::string& collider) {
  const std::size_t c = at(find_collider(figure.from, collider));
  const std::size_t j = at(find_joint(figure.from, figure.from.colliders[c].joint));
  return figure.slots[j] + "/" + collider_names(figure.from)[c];
}

void allow_contacts_at_rest(const std::string& name, Library& library) {
  const Result<Character> built = build_character({name, {}, {}}, library);
  if (!built) return;  // start() reports the fault
  std::vector<Rigid> world(built->joints().size());
  forward_kinematics(*built, built->rest_root(), built->rest_coords(), world);
  const auto placed = [&](int c) {
    const Collider& collider = built->colliders()[at(c)];
    return moved(world[at(collider.joint)], solid_of(collider.shape));
  };
  for (const ColliderPair& pair : built->judged_colliders())
    if (signed_distance(placed(pair.a), placed(pair.b), 0.0) < 0.0)
      library.characters[name].allowed_pairs.push_back(
          {built->colliders()[at(pair.a)].name, built->colliders()[at(pair.b)].name, std::string(kOverlapAtRest)});
}

void add_character(const GuestCharacter& from, const Basis& basis, Library& library) {
  const GuestFigure figure{from, basis, joint_names(from), slots_of(from)};
  CharacterDesc character;
  character.name = from.name;
  for (std::size_t j = 0; j < figure.names.size(); ++j) {
    if (j > 0 && !figure.begins_slot(j)) continue;
    if (std::ranges::find(character.slots, figure.slots[j], &SlotDesc::name) != character.slots.end()) continue;
    character.slots.push_back(slot_desc(figure, j));
    for (const std::string& part : character.slots.back().parts)
      library.parts[part] = part_desc(figure, figure.slots[j], part);
  }
  for (const auto& [a, b] : from.may_touch)
    character.allowed_pairs.push_back({full_name(figure, a), full_name(figure, b), "The manifest allows it."});
  library.characters[from.name] = std::move(character);
  allow_contacts_at_rest(from.name, library);
}

}  // namespace

std::vector<std::string> joint_names(const GuestCharacter& character) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  const std::vector<std::string> slots = slots_of(character);
  for (std::size_t j = 0; j < slots.size(); ++j)
    names.push_back(slots[j] + "/" + own_name(character.joints[j].name, slots[j]));
  names = unique_names(names);
  for (std::size_t j = 0; j < slots.size(); ++j) names[j].erase(0, slots[j].size() + 1);
  return names;
}

std::string part_name(const GuestCharacter& character, const std::string& slot, std::size_t index) {
  const auto parts = character.parts.find(slot);
  return character.name + "_" + (parts == character.parts.end() ? slot : slot + "_" + parts->second[index]);
}

std::string part_asked_for(const GuestCharacter& character, const std::string& slot, const std::string& part) {
  const auto parts = character.parts.find(slot);
  for (std::size_t i = 1; parts != character.parts.end() && i < parts->second.size(); ++i)
    if (part_name(character, slot, i) == part) return parts->second[i];
  return "";
}

const GuestCharacter* find_character(const GuestManifest& manifest, std::string_view name) {
  const auto found = std::ranges::find(manifest.characters, name, &GuestCharacter::name);
  return found == manifest.characters.end() ? nullptr : &*found;
}

Rigid root_at_rest(const GuestManifest& manifest, std::string_view character) {
  const Basis basis(manifest.convention);
  const GuestJoint& root = find_character(manifest, character)->joints.front();
  const auto& [x, y, z, w] = root.rotation;
  return {glm::normalize(basis.rotation(x, y, z, w)), basis.point_m(root.position)};
}

std::vector<int> joints_of(const GuestCharacter& from, const Character& character) {
  const std::vector<std::string> names = joint_names(from), slots = slots_of(from);
  std::vector<int> joints{0};
  for (std::size_t j = 1; j < names.size(); ++j) joints.push_back(character.find_joint(slots[j] + "/" + names[j]));
  return joints;
}

Library library_of(const GuestManifest& manifest) {
  Library library;
  const Basis basis(manifest.convention);
  for (const GuestCharacter& character : manifest.characters) add_character(character, basis, library);
  return library;
}

std::vector<Coupling> couplings_of(const GuestCharacter& from, const std::vector<int>& joints) {
  std::vector<Coupling> out;
  for (std::size_t j = 0; j < from.joints.size(); ++j)
    if (const std::optional<GuestFollow>& follows = from.joints[j].follows)
      out.push_back({.joint = joints[j],
                     .leader = joints[at(find_joint(from, follows->joint))],
                     .multiplier = follows->multiplier,
                     .offset = follows->offset_deg * kRadPerDeg,
                     .is_of_rotation = true});
  return out;
}

}  // namespace contort
