// Compares our times with a peer's, in one process: alternating slices, and medians, because the clocks of shared
// machines vary by 15 %.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace contort {

inline double thread_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace contort
