#include "generator/motion/blend.h"

#include <algorithm>
#include <array>

#include "generator/motion/joint_clamp.h"

namespace contort {

namespace {

constexpr double kAtEnd = -1e-6;  // of half a range: rounding puts an angle at its limit that far beyond

// The range of a ball is not convex: the arc between two rotations inside of it may leave it, and then goes along its
// edge.
void blend_joint(const Joint& joint, const double* a, const double* b, double weight, double* out) {
  if (joint.kind == JointKind::ball) {
    const Quat q = slerp_short(quat_at(a), quat_at(b), weight);
    std::array<double, 4> between{q.w, q.x, q.y, q.z};
    const bool has_left = normalised_margin(joint, between.data()) < 0.0 && normalised_margin(joint, a) >= kAtEnd &&
                          normalised_margin(joint, b) >= kAtEnd;
    if (has_left) clamp_to_range(joint, between.data());
    std::ranges::copy(between, out);
  } else if (joint.kind != JointKind::root) {
    out[0] = a[0] + (b[0] - a[0]) * weight;
  }
}

// The weight may be above 1: the postures are extrapolated then.
void weigh_part(const Character& character, std::size_t part, const Posture& a, const Posture& b, double weight,
                Posture& out) {
  const Part& own = character.parts()[part];
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j) {
    const Joint& joint = character.joints()[static_cast<std::size_t>(j)];
    blend_joint(joint, a.coords.data() + joint.coord, b.coords.data() + joint.coord, weight,
                out.coords.data() + joint.coord);
  }
  if (part != 0) return;
  out.root = part_way(a.root, b.root, weight);
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
  weigh_part(character, part, a, b, weight, out);
}

void coast_part(const Character& character, std::size_t part, const Posture& a, const Posture& b, double steps,
                Posture& out) {
  weigh_part(character, part, a, b, 1.0 + steps, out);
}

}  // namespace contort
