#include "generator/dynamics/racing.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"

namespace contort {

namespace {

// The share of a joint's velocity that stays within its limit; 1 where the joint does not race.
double share_left(std::span<const double> velocity, double fastest) {
  const double most = kRacing * fastest, squared = dot(velocity, velocity);
  return squared > most * most ? most / std::sqrt(squared) : 1.0;
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

void stop_racing(const Multibody& body, std::span<const double> fastest, std::span<double> velocity) {
  for (const Link& link : body.links().subspan(1)) {
    const auto dof = static_cast<std::size_t>(link.dof), count = static_cast<std::size_t>(link.dof_count);
    const std::span<double> own = velocity.subspan(dof, count);
    const double left = share_left(own, fastest[dof]);
    for (double& rate : own) rate *= left;
  }
}

}  // namespace contort
