// Forward kinematics of whole motions, several frames in each instruction. The result has the same bits as
// forward_kinematics: each SIMD lane does the same operations in the same order, without fused multiply-adds.
#pragma once

#include <vector>

#include "model/motion/motion.h"

namespace contort {

// A function that places several frames at a time, with the instructions that it is named after.
struct PlacingKernel {
  const char* name;  // "any" or "AVX2"
  // Places as many frames as it can, from the first on, and returns their number. `world` is indexed by frame *
  // joint_count + joint.
  std::size_t (*place)(const Character& character, const Motion& motion, Rigid* world);
};

// The kernels that this machine can run, the fastest last.
std::span<const PlacingKernel> placing_kernels();

// Computes world_from_joint of all joints in all frames, at index frame * joint_count + joint.
void place_frames(const Character& character, const Motion& motion, std::vector<Rigid>& world,
                  const PlacingKernel& kernel = placing_kernels().back());

}  // namespace contort
