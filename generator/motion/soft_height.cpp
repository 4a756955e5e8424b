#include "generator/motion/soft_height.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kJolt_m_s2 = 5.0;  // by which an acceleration changes
constexpr double kJolt_s = 0.05;    // within twice this
constexpr double kReach_s = 0.2;
constexpr int kSmoothings = 4;

void put_around(int frame, int reach, double value, std::vector<double>& values) {
  const int last = static_cast<int>(values.size()) - 1;
  for (int k = std::max(0, frame - reach); k <= std::min(last, frame + reach); ++k) values[at(k)] = value;
}

// 1 around jolts, 0 elsewhere and around frames that are kept; empty where there is no jolt.
std::vector<double> share_of_jolts(std::span<const double> heights_m, std::span<const char> kept, double rate_hz,
                                   int reach) {
  const int count = static_cast<int>(heights_m.size());
  const int beside = std::max(1, static_cast<int>(std::lround(kJolt_s * rate_hz)));
  const auto lift = [&](int f) {
    return rate_hz * rate_hz * (heights_m[at(f + 1)] - 2.0 * heights_m[at(f)] + heights_m[at(f - 1)]);
  };
  std::vector<double> share(heights_m.size(), 0.0);
  bool any = false;
  for (int f = 1 + beside; f < count - 1 - beside; ++f) {
    if (std::fabs(lift(f + beside) - lift(f - beside)) < kJolt_m_s2) continue;
    any = true;
    put_around(f, 2 * reach, 1.0, share);
  }
  for (int f = 0; f < count; ++f)
    if (kept[at(f)] != 0) put_around(f, reach, 0.0, share);
  if (!any) share.clear();
  return share;
}

// By frame the greatest value of `over` less `below` within a reach, at least 0.
std::vector<double> greatest_excess(const std::vector<double>& over, std::span<const double> below, int reach) {
  const int last = static_cast<int>(over.size()) - 1;
  std::vector<double> excess(over.size(), 0.0);
  for (int f = 0; f <= last; ++f)
    for (int k = std::max(0, f - reach); k <= std::min(last, f + reach); ++k)
      excess[at(f)] = std::max(excess[at(f)], over[at(k)] - below[at(k)]);
  return excess;
}

// The moving mean, lowered until it is nowhere above.
std::vector<double> smooth_below(std::span<const double> heights_m, int window) {
  std::vector<double> lower_m(heights_m.size(), 0.0), smooth_m;
  for (int again = 0; again < kSmoothings; ++again) {
    smooth_m.assign(heights_m.begin(), heights_m.end());
    for (std::size_t f = 0; f < smooth_m.size(); ++f) smooth_m[f] -= lower_m[f];
    smooth_twice(window, smooth_m);
    const std::vector<double> over_m = greatest_excess(smooth_m, heights_m, window);
    for (std::size_t f = 0; f < lower_m.size(); ++f) lower_m[f] += over_m[f];
  }
  return smooth_m;
}

}  // namespace

std::vector<double> soft_envelope(int reach, std::span<const double> values) {
  const int count = static_cast<int>(values.size());
  std::vector<double> out(values.size(), 0.0);
  for (int f = 0; f < count; ++f) {
    if (values[at(f)] <= 0.0) continue;
    for (int g = std::max(0, f - reach); g <= std::min(count - 1, f + reach); ++g) {
      const double away = static_cast<double>(g - f) / (reach + 1), near = 1.0 - away * away;
      out[at(g)] = std::max(out[at(g)], values[at(f)] * near * near);
    }
  }
  return out;
}

void smooth_twice(int window, std::vector<double>& values) {
  const int last = static_cast<int>(values.size()) - 1;
  for (int twice = 0; twice < 2; ++twice) {
    const std::vector<double> before = values;
    for (int f = 0; f <= last; ++f) {
      double sum = 0.0;
      for (int k = -window; k <= window; ++k) sum += before[at(std::clamp(f + k, 0, last))];
      values[at(f)] = sum / (2 * window + 1);
    }
  }
}

std::vector<double> without_jolts(std::span<const double> heights_m, std::span<const char> kept, double rate_hz) {
  std::vector<double> heights(heights_m.begin(), heights_m.end());
  const int reach = std::max(1, static_cast<int>(kReach_s * rate_hz));
  std::vector<double> share = share_of_jolts(heights_m, kept, rate_hz, reach);
  if (share.empty()) return heights;
  smooth_twice(reach, share);
  const std::vector<double> smooth_m = smooth_below(heights_m, reach / 2);
  // The last lowering may leave a little above: such frames keep their height.
  for (std::size_t f = 0; f < heights.size(); ++f) heights[f] += share[f] * std::min(0.0, smooth_m[f] - heights_m[f]);
  return heights;
}

}  // namespace contort
