#include "model/motion/motion.h"

#include <algorithm>

#include "model/core/hash.h"

namespace contort {

namespace {

void add_frame(Hash64& hash, const Motion& motion, int frame) {
  const Rigid& root = motion.root[static_cast<std::size_t>(frame)];
  for (const double value : {root.q.w, root.q.x, root.q.y, root.q.z, root.p_m.x, root.p_m.y, root.p_m.z})
    hash.add(value);
  hash.add(motion.row(frame));
}

}  // namespace

std::uint64_t motion_hash(const Motion& motion) {
  Hash64 hash;
  hash.add(motion.rate_hz);
  hash.add(static_cast<std::uint64_t>(motion.frame_count));
  for (int frame = 0; frame < motion.frame_count; ++frame) add_frame(hash, motion, frame);
  return hash.value();
}

std::vector<std::uint16_t> motion_trace(const Motion& motion) {
  Hash64 hash;
  std::vector<std::uint16_t> trace;
  trace.reserve(static_cast<std::size_t>(motion.frame_count));
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    add_frame(hash, motion, frame);
    trace.push_back(static_cast<std::uint16_t>(hash.value() >> 48));
  }
  return trace;
}

int first_difference(const Motion& a, const Motion& b) {
  const std::vector<std::uint16_t> trace_a = motion_trace(a);
  const std::vector<std::uint16_t> trace_b = motion_trace(b);
  const auto [at_a, at_b] = std::mismatch(trace_a.begin(), trace_a.end(), trace_b.begin(), trace_b.end());
  return at_a == trace_a.end() && at_b == trace_b.end() ? -1 : static_cast<int>(at_a - trace_a.begin());
}

}  // namespace contort
