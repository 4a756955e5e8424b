// Converts the frames of a generator that is a program of its own to a motion.
#pragma once

#include <span>
#include <string_view>

#include "guest/basis.h"
#include "guest/manifest.h"
#include "model/character/character.h"
#include "model/motion/foreign.h"
#include "model/motion/motion.h"

namespace contort {

// The layout of a character's frames.
struct FrameLayout {
  const Character& character;
  std::span<const int> joints;  // our joints, in the order of the manifest
  Basis basis;
  FrameFormat format = FrameFormat::f64;
};

std::size_t bytes_of(const FrameLayout& layout, int frames);

// Overwrites coordinates, root, and number of frames. There must be bytes_of() bytes. A ball takes the whole rotation.
// A hinge takes the part about its axis, and the rest of the rotation goes into the facts. A quaternion of length 0
// stands for no rotation relative to rest. NaN stays NaN.
void read_frames(std::string_view bytes, const FrameLayout& layout, int frames, Motion& motion, ForeignFacts& facts);

// Sets a joint to a rotation relative to its parent. For a hinge, the rotation that is not about its axis is added to
// off_axis_rad.
void set_rotation(const Joint& joint, const Quat& in_parent, int frame, Motion& motion, double& off_axis_rad);

}  // namespace contort
