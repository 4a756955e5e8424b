#include "model/motion/place_frames.h"

#include "model/core/detmath.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// Vector types of GCC and Clang: two numbers fit into one register of every supported processor.
namespace twos {

using Lanes [[gnu::vector_size(16)]] = double;

#include "model/motion/place_frames.inl"

}  // namespace twos

#ifdef __x86_64__
#include "model/core/avx2_begin.inl"

namespace avx2 {

using Lanes [[gnu::vector_size(32)]] = double;

#include "model/motion/place_frames.inl"

}  // namespace avx2

#include "model/core/avx2_end.inl"
#endif

std::vector<PlacingKernel> find_kernels() {
  std::vector<PlacingKernel> found{{"any", twos::place_whole}};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) found.push_back({"AVX2", avx2::place_whole});
#endif
  return found;
}

}  // namespace

std::span<const PlacingKernel> placing_kernels() {
  static const std::vector<PlacingKernel> kernels = find_kernels();
  return kernels;
}

void place_frames(const Character& character, const Motion& motion, std::vector<Rigid>& world,
                  const PlacingKernel& kernel) {
  const std::size_t joints = character.joints().size(), frames = static_cast<std::size_t>(motion.frame_count);
  world.resize(joints * frames);
  for (std::size_t f = kernel.place(character, motion, world.data()); f < frames; ++f)
    forward_kinematics(character, motion.root[f], motion.row(static_cast<int>(f)),
                       std::span(world).subspan(f * joints, joints));
}

}  // namespace contort
