#include "generator/dynamics/racing.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"

namespace contort {

namespace {

// The share of a velocity that is not more than `most`; 1 where all of it is.
double share_within(std::span<const double> velocity, double most) {
  const double squared = dot(velocity, velocity);
  return squared > most * most ? most / std::sqrt(squared) : 1.0;
}

// The share of a joint's velocity that stays within its limit; 1 where the joint does not race.
double share_left(std::span<const double> velocity, double fastest) {
  return share_within(velocity, kRacing * fastest);
}

}  // namespace

bool races(const Multibody& body, std::span<const double> fastest, std::span<const double> velocity,
           std::span<const double> acceleration, double tick_s) {
  return std::ranges::any_of(body.links().subspan(1), [&](const Link& link) {
    const auto dof = static_cast<std::size_t>(link.dof), count = static_cast<std::size_t>(link.dof_count);
    double then[kRootDofs];
    for (std::size_t k = 0; k < count; ++k) then[k] = velocity[dof + k] + tick_s * acceleration[dof + k];
    return share_left(std::span(then).first(count), fastest[dof]) < 1.0;
  });
}

bool stop_racing(const Multibody& body, std::span<const double> fastest, std::span<double> velocity) {
  bool any = false;
  const auto keep = [&](std::span<double> own, double share) {
    any = any || share < 1.0;
    for (double& rate : own) rate *= share;
  };
  const std::span<double> spin = velocity.subspan(3, 3);
  keep(spin, share_within(spin, kFastestSpin_rad_s));
  for (const Link& link : body.links().subspan(1)) {
    const auto dof = static_cast<std::size_t>(link.dof), count = static_cast<std::size_t>(link.dof_count);
    const std::span<double> own = velocity.subspan(dof, count);
    keep(own, share_left(own, fastest[dof]));
  }
  return any;
}

}  // namespace contort
