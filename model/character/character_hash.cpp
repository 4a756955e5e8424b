#include <variant>

#include "model/character/assembly.h"
#include "model/core/hash.h"

namespace contort {

namespace {

struct HashShape {
  Hash64& hash;
  void operator()(const Sphere& s) const { add(0, {s.center_m}, s.radius_m); }
  void operator()(const Capsule& c) const { add(1, {c.a_m, c.b_m}, c.radius_m); }
  void operator()(const Box& b) const { add(2, {b.center_m, b.half_m, b.rotation_deg}, 0.0); }
  void operator()(const ConvexHull& hull) const {
    hash.add(std::uint64_t{3});
    hash.add(static_cast<std::uint64_t>(hull.points_m.size()));
    for (const Vec3& p : hull.points_m)
      for (int i = 0; i < 3; ++i) hash.add(p[i]);
  }
  void add(std::uint64_t tag, std::initializer_list<Vec3> vectors, double radius_m) const {
    hash.add(tag);
    for (const Vec3& v : vectors)
      for (int i = 0; i < 3; ++i) hash.add(v[i]);
    hash.add(radius_m);
  }
};

void add_vec(Hash64& hash, const Vec3& v) {
  for (int i = 0; i < 3; ++i) hash.add(v[i]);
}

void add_quat(Hash64& hash, const Quat& q) {
  for (const double value : {q.w, q.x, q.y, q.z}) hash.add(value);
}

void add_joint(Hash64& hash, const Joint& joint) {
  hash.add(joint.name);
  hash.add(static_cast<std::uint64_t>(joint.kind));
  hash.add(static_cast<std::uint64_t>(joint.parent + 1));
  add_quat(hash, joint.parent_from_joint.q);
  add_quat(hash, joint.swing_center);
  for (const Vec3& v : {joint.parent_from_joint.p_m, joint.axis, joint.swing_axis, joint.center_of_mass_m,
                        joint.inertia_kg_m2[0], joint.inertia_kg_m2[1], joint.inertia_kg_m2[2]})
    add_vec(hash, v);
  for (const double value : {joint.low, joint.high, joint.swing_a_rad, joint.swing_b_rad, joint.max_speed,
                             joint.strength_low, joint.strength_high, joint.mass_kg})
    hash.add(value);
}

void add_chains(Hash64& hash, const Part& part) {
  hash.add(part.slot);
  for (const ReachChain& chain : part.reach)
    for (const int index : {chain.upper, chain.middle, chain.tip}) hash.add(static_cast<std::uint64_t>(index));
  for (const FacingChain& chain : part.facing) {
    for (const int joint : chain.joints) hash.add(static_cast<std::uint64_t>(joint));
    hash.add(static_cast<std::uint64_t>(chain.socket));
  }
}

}  // namespace

std::uint64_t hash_of(const Character& character) {
  Hash64 hash;
  for (const Joint& joint : character.joints()) add_joint(hash, joint);
  for (const Collider& collider : character.colliders()) {
    hash.add(collider.name);
    hash.add(static_cast<std::uint64_t>(collider.joint));
    std::visit(HashShape{hash}, collider.shape);
  }
  for (const Body& body : character.bodies()) hash.add(body.name);
  for (const ColliderPair& pair : character.judged_colliders())
    hash.add(static_cast<std::uint64_t>(pair.a) << 32 | static_cast<std::uint64_t>(pair.b));
  for (const Socket& socket : character.sockets()) {
    hash.add(socket.name);
    add_quat(hash, socket.joint_from_socket.q);
    add_vec(hash, socket.joint_from_socket.p_m);
  }
  for (const Part& part : character.parts()) add_chains(hash, part);
  for (const ActionDesc& action : character.actions()) hash.add(print_action(action));
  for (const JointGroup& group : character.control_groups()) {
    hash.add(group.greatest);
    for (const int joint : group.joints) hash.add(static_cast<std::uint64_t>(joint));
  }
  for (const Region& region : character.regions()) {
    hash.add(region.name);
    hash.add(static_cast<std::uint64_t>(region.joint) << 1 | static_cast<std::uint64_t>(region.keep_out));
    add_vec(hash, region.point_m);
    std::visit(HashShape{hash}, region.shape);
  }
  if (character.declared_withstands_N_s()) hash.add(*character.declared_withstands_N_s());
  return hash.value();
}

}  // namespace contort
