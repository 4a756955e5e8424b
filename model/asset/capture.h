// Motion capture with declared limits, as in ASF and AMC files: bones with degrees of freedom and, unlike in other
// formats, the limits that the maker of the skeleton declared for them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/math.h"

namespace contort {

enum class DofKind : std::uint8_t { rx, ry, rz, tx, ty, tz, length };
inline constexpr std::array<std::string_view, 7> kDofNames = {"rx", "ry", "rz", "tx", "ty", "tz", "l"};
inline std::string_view dof_name(DofKind kind) { return kDofNames[static_cast<std::size_t>(kind)]; }
inline bool is_rotation(DofKind kind) { return kind <= DofKind::rz; }

// A degree of freedom: one number of a bone's line in each frame.
struct AsfDof {
  DofKind kind = DofKind::rx;
  // Rad for rotations, otherwise the file's unit of length. Both are infinite if no limits are declared.
  double low = 0.0;
  double high = 0.0;
  bool operator==(const AsfDof&) const = default;
};

struct AsfBone {
  std::string name;
  int parent = -1;          // Not always smaller than the own index.
  Vec3 direction{0.0};      // From the bone's beginning to its end, in the global frame of the rest pose.
  double length = 0.0;      // In the file's unit; 0 for the root.
  Quat axis = kNoRotation;  // C: global_from_bone at rest. Degrees of freedom turn about the axes of this frame.
  // The order in which rotations are applied, 0 for x: {0, 1, 2} turns about x first, so that the product is Rz * Ry
  // * Rx.
  std::array<int, 3> turn_order = {0, 1, 2};
  std::vector<AsfDof> dofs;  // In the order of the AMC's numbers.
  bool operator==(const AsfBone&) const = default;
};

struct AsfSkeleton {
  std::string name;
  double length_unit = 1.0;    // As declared. With CMU's 0.45, a length of 1 is 1 / 0.45 inches.
  bool is_in_degrees = false;  // True if the file's angles are in degrees; values here are always rad.
  Vec3 root_position{0.0};
  std::vector<AsfBone> bones;  // Bone 0 is the root; the others are in the file's order.
  std::vector<int> order;      // Every bone once, parents before children.
  bool operator==(const AsfSkeleton&) const = default;
};

// A motion of such a skeleton: its numbers.
struct AmcMotion {
  int first_frame = 0;  // The file's number of the first frame, mostly 1. Numbers have no gaps.
  int frame_count = 0;
  int dof_count = 0;  // Number of degrees of freedom of all bones, including the root.
  std::vector<double>
      values;  // Frame by frame; in a frame bone by bone in the skeleton's order, not the AMC's. In rad.
  bool operator==(const AmcMotion&) const = default;

  std::span<const double> row(int frame) const {
    const auto dofs = static_cast<std::size_t>(dof_count);
    return std::span(values).subspan(static_cast<std::size_t>(frame) * dofs, dofs);
  }
};

}  // namespace contort
