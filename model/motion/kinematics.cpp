#include "model/motion/kinematics.h"

#include <algorithm>
#include <array>

#include "model/core/detmath.h"
#include "model/core/index.h"

namespace contort {

Rigid joint_motion(const Joint& joint, std::span<const double> row) {
  const double* q = row.data() + joint.coord;
  switch (joint.kind) {
    case JointKind::hinge: return {axis_angle(joint.axis, q[0]), Vec3(0.0)};
    case JointKind::ball: return {Quat(q[0], q[1], q[2], q[3]), Vec3(0.0)};
    case JointKind::prismatic: return {kNoRotation, q[0] * joint.axis};
    case JointKind::root: break;
  }
  return {};
}

namespace {

// Applies the joint's own motion to its transform at rest. For a hinge, `half` has the sine and cosine of half its
// angle.
void move(const Joint& joint, const double* q, const det::SinCos& half, Rigid& world_from_joint) {
  auto& [turn, place_m] = world_from_joint;
  const Vec3& axis = joint.axis;
  switch (joint.kind) {
    case JointKind::hinge: turn = turn * Quat(half.cos, half.sin * axis.x, half.sin * axis.y, half.sin * axis.z); break;
    case JointKind::ball: turn = turn * Quat(q[0], q[1], q[2], q[3]); break;
    case JointKind::prismatic: place_m += turn * (q[0] * axis); break;
    case JointKind::root: break;
  }
}

// Places the joints index_at(0), … in this order, several at a time: the sines of two hinges at once take as long as
// those of one.
template <class IndexAt>
void place_joints(const Character& character, std::span<const double> row, int count, IndexAt index_at,
                  std::span<Rigid> world) {
  constexpr int kAtOnce = 8;
  std::array<double, kAtOnce> half_rad;
  std::array<det::SinCos, kAtOnce> halves;
  for (int first = 0; first < count; first += kAtOnce) {
    const int end = std::min(first + kAtOnce, count);
    std::size_t hinges = 0;
    for (int i = first; i < end; ++i)
      if (const Joint& joint = character.joint(index_at(i)); joint.kind == JointKind::hinge)
        half_rad[hinges++] = 0.5 * row[at(joint.coord)];
    det::sincos(std::span(half_rad).first(hinges), halves);
    const det::SinCos* half = halves.data();
    for (int i = first; i < end; ++i) {
      const Joint& joint = character.joint(index_at(i));
      if (joint.kind == JointKind::root) continue;
      Rigid& own = world[at(index_at(i))];
      own = world[at(joint.parent)] * joint.parent_from_joint;
      move(joint, row.data() + joint.coord, *half, own);
      half += joint.kind == JointKind::hinge;
    }
  }
}

}  // namespace

void forward_kinematics(const Character& character, std::span<const double> row, int first, int last,
                        std::span<Rigid> world) {
  place_joints(character, row, last - first, [&](int i) { return first + i; }, world);
}

void forward_kinematics(const Character& character, std::span<const double> row, std::span<const int> joints,
                        std::span<Rigid> world) {
  place_joints(character, row, static_cast<int>(joints.size()), [&](int i) { return joints[at(i)]; }, world);
}

void forward_kinematics(const Character& character, const Rigid& root, std::span<const double> row,
                        std::span<Rigid> world) {
  world[0] = root;
  forward_kinematics(character, row, 1, static_cast<int>(character.joints().size()), world);
}

Rigid world_from_socket(const Character& character, std::span<const Rigid> world, int socket) {
  const Socket& s = character.sockets()[static_cast<std::size_t>(socket)];
  return world[static_cast<std::size_t>(s.joint)] * s.joint_from_socket;
}

}  // namespace contort
