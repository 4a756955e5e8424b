#include "generator/motion/walk_on_spot.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "generator/motion/low_pass.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kRootStays = 0.25;    // of the ground's speed: a root whose mean speed is less stays
constexpr double kLeast = 0.12;    // of the speed of the legs as pendulums; slower feet count as resting
constexpr double kAlike = 0.4;     // of the ground's speed: velocities that differ by less from it agree with it
constexpr double kMostAgree = 0.5; // of the frames
constexpr int kFewestFrames = 8;
constexpr int kMostFrames = 600;  // the median compares all with all

Vec3 level(const Vec3& v) { return {v.x, 0.0, v.z}; }

// The horizontal velocity of the lowest end of any foot.
Vec3 lowest_end_m_s(std::span<const Leg> legs, std::span<const SolePath> paths, const Environment& environment,
                    int frame, double rate_hz) {
  double lowest_m = std::numeric_limits<double>::infinity();
  Vec3 velocity_m_s(0.0);
  for (std::size_t i = 0; i < legs.size(); ++i)
    for (const double z_m : {legs[i].low_m.z, legs[i].high_m.z}) {
      const Vec3 end(0.0, 0.0, z_m);
      const double height_m = ground_below(environment, paths[i][at(frame)] * end).height_m;
      if (!(height_m < lowest_m)) continue;
      lowest_m = height_m;
      velocity_m_s = 0.5 * rate_hz * level(paths[i][at(frame + 1)] * end - paths[i][at(frame - 1)] * end);
    }
  return velocity_m_s;
}

}  // namespace

Vec3 belt_velocity_m_s(std::span<const Leg> legs, std::span<const SolePath> paths, const Environment& environment,
                       const Motion& motion) {
  if (legs.empty() || motion.frame_count < kFewestFrames) return Vec3(0.0);
  std::vector<Vec3> velocities;
  const int step = 1 + motion.frame_count / kMostFrames;
  for (int f = 1; f + 1 < motion.frame_count; f += step)
    velocities.push_back(lowest_end_m_s(legs, paths, environment, f, motion.rate_hz));
  const Vec3 belt_m_s = median(velocities);
  const double speed_m_s = length(belt_m_s), time_s = (motion.frame_count - 1) / motion.rate_hz;
  const double root_m_s = length(level(motion.root.back().p_m - motion.root.front().p_m)) / time_s;
  if (root_m_s > kRootStays * speed_m_s || speed_m_s < kLeast * pendulum_rad_s(legs[0]) * legs[0].length_m)
    return Vec3(0.0);
  const auto agree = static_cast<double>(std::ranges::count_if(velocities, [&](const Vec3& v) {
    return length(v - belt_m_s) < kAlike * speed_m_s;
  }));
  return agree >= kMostAgree * static_cast<double>(velocities.size()) ? belt_m_s : Vec3(0.0);
}

}  // namespace contort
