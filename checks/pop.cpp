#include "checks/pop.h"

#include <algorithm>
#include <limits>

namespace contort {

namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

// The faster neighbour of the window [first, last], or infinite where that is no window of a pop.
double neighbours_rad_s(std::span<const SpeedInterval> v, std::size_t first, std::size_t last) {
  const bool has_before = first > 0;
  const bool has_after = last + 1 < v.size();
  if (last >= v.size() || (!has_before && !has_after)) return kNothing;
  if (v[last].t1_s - v[first].t0_s > kPopLongest_s) return kNothing;
  return std::max(has_before ? v[first - 1].speed_rad_s : 0.0, has_after ? v[last + 1].speed_rad_s : 0.0);
}

}  // namespace

double explained_rad_s(std::span<const SpeedInterval> between_keys, std::size_t i) {
  double calmest = std::min(neighbours_rad_s(between_keys, i, i), neighbours_rad_s(between_keys, i, i + 1));
  if (i > 0) calmest = std::min(calmest, neighbours_rad_s(between_keys, i - 1, i));
  return kPopFactor * calmest;
}

}  // namespace contort
