#include "generator/motion/lowering.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "generator/motion/soft_height.h"

namespace contort {

namespace {

constexpr double kSoftly_s = 0.2;  // before and after the frame
constexpr double kReached_m = 2e-4;
constexpr double kMostAtOnce_m = 0.03;

}  // namespace

double too_high_m(const Leg& leg, const Vec3& hip_m, const Rigid& world_from_sole, double stretch) {
  const Vec3 way = world_from_sole * leg.sole_from_ankle - hip_m;
  const double longest_m = stretch * leg.length_m, level2 = way.x * way.x + way.z * way.z;
  return std::max(0.0, -way.y - std::sqrt(std::max(0.0, longest_m * longest_m - level2)));
}

bool lower_softly(std::span<const double> missing_m, Motion& motion) {
  const int reach = std::max(1, static_cast<int>(kSoftly_s * motion.rate_hz));
  std::vector<double> lower_m;
  for (const double missing : missing_m)
    lower_m.push_back(missing > kReached_m ? std::min(missing, kMostAtOnce_m) : 0.0);
  if (std::ranges::all_of(lower_m, [](double m) { return m == 0.0; })) return false;
  lower_m = soft_envelope(reach, lower_m);
  for (std::size_t f = 0; f < lower_m.size(); ++f) motion.root[f].p_m.y -= lower_m[f];
  return true;
}

}  // namespace contort
