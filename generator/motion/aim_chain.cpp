#include "generator/motion/aim_chain.h"

#include <algorithm>

#include "model/core/assert.h"
#include "model/core/hash.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

void keep_outermost(std::vector<int>& joints) {
  if (joints.size() > kMaxAimJoints) joints.erase(joints.begin(), joints.end() - kMaxAimJoints);
}

// ancestor_from_joint at rest.
Rigid at_rest(const Character& character, int ancestor, int joint) {
  Rigid ancestor_from_joint;
  for (int j = joint; j > ancestor; j = character.joint(j).parent)
    ancestor_from_joint = character.joint(j).parent_from_joint * ancestor_from_joint;
  return ancestor_from_joint;
}

void add(Hash64& hash, const Vec3& v) {
  for (const double x : {v.x, v.y, v.z}) hash.add(x);
}

void add(Hash64& hash, const Quat& q) {
  for (const double x : {q.w, q.x, q.y, q.z}) hash.add(x);
}

}  // namespace

AimChain aim_chain_for(const Character& character, int part, int socket) {
  AimChain chain{{}, socket};
  std::size_t keep = 0;
  for (int j = character.sockets()[static_cast<std::size_t>(socket)].joint; j > 0; j = character.joint(j).parent) {
    chain.joints.push_back(j);
    if (character.joint(j).part == part) keep = chain.joints.size();
  }
  chain.joints.resize(keep);
  std::ranges::reverse(chain.joints);
  keep_outermost(chain.joints);
  return chain;
}

AimChain aim_chain_for(const FacingChain& chain) {
  AimChain cut{chain.joints, chain.socket};
  keep_outermost(cut.joints);
  return cut;
}

AimGeometry aim_geometry(const Character& character, const AimChain& chain) {
  CONTORT_ASSERT(!chain.joints.empty() && chain.joints.size() <= kMaxAimJoints);
  AimGeometry geometry;
  int before = character.joint(chain.joints.front()).parent;
  for (const int j : chain.joints) {
    Joint joint = character.joint(j);
    joint.name = joint.local_name = joint.body_name = {};
    joint.parent_from_joint = at_rest(character, before, j);
    joint.coord = geometry.coord_count;
    geometry.coord_count += coord_size(joint.kind);
    geometry.joints.push_back(std::move(joint));
    before = j;
  }
  const Socket& socket = character.sockets()[static_cast<std::size_t>(chain.socket)];
  geometry.last_from_socket = at_rest(character, before, socket.joint) * socket.joint_from_socket;
  return geometry;
}

std::uint64_t geometry_hash(const AimGeometry& geometry) {
  Hash64 hash;
  for (const Joint& joint : geometry.joints) {
    hash.add(static_cast<std::uint64_t>(joint.kind));
    add(hash, joint.parent_from_joint.q);
    add(hash, joint.parent_from_joint.p_m);
    add(hash, joint.axis);
    for (const double limit : {joint.low, joint.high}) hash.add(limit);
    if (joint.kind != JointKind::ball) continue;
    add(hash, joint.swing_axis);
    for (const double limit : {joint.swing_a_rad, joint.swing_b_rad}) hash.add(limit);
    add(hash, joint.swing_center);
  }
  add(hash, geometry.last_from_socket.q);
  add(hash, geometry.last_from_socket.p_m);
  return hash.value();
}

Rigid base_from_socket(const AimGeometry& geometry, std::span<const double> coords) {
  Rigid placed;
  for (const Joint& joint : geometry.joints) placed = placed * joint.parent_from_joint * joint_motion(joint, coords);
  return placed * geometry.last_from_socket;
}

}  // namespace contort
