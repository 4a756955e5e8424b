#include "generator/motion/blend.h"

#include <algorithm>

namespace contort {

namespace {

void blend_joint(const Joint& joint, const double* a, const double* b, double weight, double* out) {
  if (joint.kind == JointKind::ball) {
    const Quat q = slerp_short(Quat(a[0], a[1], a[2], a[3]), Quat(b[0], b[1], b[2], b[3]), weight);
    out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
  } else if (joint.kind != JointKind::root) {
    out[0] = a[0] + (b[0] - a[0]) * weight;
  }
}

}  // namespace

void copy_part(const Character& character, std::size_t part, const Posture& from, Posture& to) {
  const Part& own = character.parts()[part];
  std::copy_n(from.coords.begin() + own.first_coord, own.coord_count, to.coords.begin() + own.first_coord);
  if (part == 0) to.root = from.root;
}

void blend_part(const Character& character, std::size_t part, const Posture& a, const Posture& b, double weight,
                Posture& out) {
  // Bit by bit: what has arrived is there, and what has faded is gone.
  if (weight <= 0.0) return copy_part(character, part, a, out);
  if (weight >= 1.0) return copy_part(character, part, b, out);
  const Part& own = character.parts()[part];
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j) {
    const Joint& joint = character.joints()[static_cast<std::size_t>(j)];
    blend_joint(joint, a.coords.data() + joint.coord, b.coords.data() + joint.coord, weight,
                out.coords.data() + joint.coord);
  }
  if (part != 0) return;
  out.root = {slerp_short(a.root.q, b.root.q, weight), a.root.p_m + (b.root.p_m - a.root.p_m) * weight};
}

}  // namespace contort
