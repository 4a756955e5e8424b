#include <algorithm>
#include <cmath>

#include "generator/motion/gait.h"

namespace contort {

namespace {

constexpr double kGravity_m_s2 = 9.81;

GaitParams params_for(std::span<const Leg> legs, double speed_m_s, double stride_per_leg) {
  GaitParams params;
  const double length_m = least_length_m(legs);
  params.speed_m_s = speed_m_s;
  const double root_of_froude = speed_m_s / std::sqrt(kGravity_m_s2 * length_m);
  // Strides grow with the square root of dimensionless speed (Alexander 1989: stride / leg about 2.3 Fr^0.3).
  const double stride_m = stride_per_leg * length_m * std::sqrt(std::max(root_of_froude, 0.04));
  params.cycle_s = stride_m / std::max(speed_m_s, 0.05);
  params.lift_m = 0.08 * length_m;
  params.lower_m = 0.03 * length_m;
  return params;
}

// How far the hips must be below their height at rest for every leg to bend a little still at the ends of its stance,
// when its foot is half of the stance's way in front or behind. Near straight, a knee turns very fast for a small step.
double lower_for(std::span<const Leg> legs, double stance_m) {
  constexpr double kBent = 0.97;
  double lower_m = 0.0;
  for (const Leg& leg : legs) {
    const double up_m = leg.hip_m.y - leg.sole_from_ankle.y;
    const double along_m = std::fabs(leg.hip_m.z - leg.home_m.z - leg.sole_from_ankle.z) + 0.5 * stance_m;
    const double reach_m = kBent * leg.length_m;
    const double room = reach_m * reach_m - along_m * along_m;
    lower_m = std::max(lower_m, up_m - std::sqrt(std::max(room, 0.5 * reach_m * reach_m)));
  }
  return lower_m;
}

}  // namespace

double least_length_m(std::span<const Leg> legs) {
  double least = 1e9;
  for (const Leg& leg : legs) least = std::min(least, leg.length_m);
  return legs.empty() ? 1.0 : least;
}

GaitParams walk_params(std::span<const Leg> legs, double speed_m_s) {
  const bool many = legs.size() > 2;  // more legs bear, and each takes its time: dogs walk so (Hildebrand 1968)
  GaitParams params = params_for(legs, speed_m_s, many ? 1.9 : 1.7);
  params.duty = many ? 0.66 : 0.62;
  if (many) params.lower_m = lower_for(legs, params.duty * params.cycle_s * speed_m_s);
  return params;
}

GaitParams run_params(std::span<const Leg> legs, double speed_m_s) {
  GaitParams params = params_for(legs, speed_m_s, 1.7);
  params.trot = true;
  params.duty = legs.size() > 2 ? 0.45 : 0.4;
  params.lift_m *= 1.5;
  params.lower_m *= 1.5;
  params.bounce_m = 0.03 * least_length_m(legs);
  return params;
}

}  // namespace contort
