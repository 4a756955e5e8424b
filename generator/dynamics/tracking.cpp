#include "generator/dynamics/tracking.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/rotation_rates.h"

namespace contort {

namespace {

double at(std::span<const double> target, int frame) { return target[static_cast<std::size_t>(frame)]; }

// Frames where the target turns round by more than a wiggle, seen from left to right: the running extremum counts once
// the target has come back from it far enough.
std::vector<int> turns(std::span<const double> target, double wiggle) {
  std::vector<int> found;
  int low = 0, high = 0, direction = 0;
  for (int f = 1; f < static_cast<int>(target.size()); ++f) {
    if (at(target, f) > at(target, high)) high = f;
    if (at(target, f) < at(target, low)) low = f;
    const bool fell = at(target, f) < at(target, high) - wiggle;
    const bool rose = at(target, f) > at(target, low) + wiggle;
    if (direction >= 0 && fell) {
      if (high > 0) found.push_back(high);
      direction = -1, low = f;
    } else if (direction <= 0 && rose) {
      if (low > 0) found.push_back(low);
      direction = 1, high = f;
    }
  }
  return found;
}

// Adds the frames in which a target that moves comes to rest for three frames or more, and where it sets out again.
void add_plateaus(std::span<const double> target, double wiggle, std::vector<int>& frames) {
  constexpr int kShortest = 3;
  const int count = static_cast<int>(target.size());
  for (int first = 0; first < count;) {
    int last = first;
    while (last + 1 < count && std::fabs(at(target, last + 1) - at(target, first)) <= 0.05 * wiggle) ++last;
    if (last - first >= kShortest) {
      if (first > 0) frames.push_back(first);
      if (last + 1 < count) frames.push_back(last);
    }
    first = last + 1;
  }
}

double slope(std::span<const double> target, int frame) {
  const int before = std::max(frame - 1, 0), after = std::min(frame + 1, static_cast<int>(target.size()) - 1);
  return after > before ? (at(target, after) - at(target, before)) / (after - before) : 0.0;
}

// The frame between two knots where the cubic through them is farthest from the target, -1 where it is near enough.
int farthest_stray(std::span<const double> target, int first, int last, double tolerance) {
  const double length = last - first;
  const double v0 = slope(target, first) * length, v1 = slope(target, last) * length;
  const double a = at(target, first), b = at(target, last);
  int worst = -1;
  for (int f = first + 1; f < last; ++f) {
    const double u = (f - first) / length;
    const double cubic = a + u * (v0 + u * (3.0 * (b - a) - 2.0 * v0 - v1 + u * (2.0 * (a - b) + v0 + v1)));
    const double stray = std::fabs(at(target, f) - cubic);
    if (stray > tolerance) worst = f, tolerance = stray;
  }
  return worst;
}

void subdivide(std::span<const double> target, int first, int last, double tolerance, std::vector<int>& frames) {
  const int middle = farthest_stray(target, first, last, tolerance);
  if (middle < 0) return;
  subdivide(target, first, middle, tolerance, frames);
  frames.push_back(middle);
  subdivide(target, middle, last, tolerance, frames);
}

void sort_unique(std::vector<int>& frames) {
  std::ranges::sort(frames);
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());  // clang++ 14 has no std::ranges::unique
}

}  // namespace

double cubic_acceleration(double from, double from_rate, double to, double to_rate, double time_s) {
  return (6.0 * (to - from) / time_s - (4.0 * from_rate + 2.0 * to_rate)) / time_s;
}

Vec3 cubic_acceleration(const Quat& from, const Vec3& from_rate, const Quat& to, const Vec3& to_rate, double time_s) {
  const Vec3 way = to_rotation_vector(glm::conjugate(from) * to);
  return (6.0 / time_s * way - (4.0 * from_rate + 2.0 * rotation_vector_rate(way, to_rate))) / time_s;
}

std::vector<int> find_knots(std::span<const double> target, const KnotOptions& options) {
  const int last = static_cast<int>(target.size()) - 1;
  if (last < 1) return {};
  std::vector<int> frames = turns(target, options.wiggle);
  add_plateaus(target, options.wiggle, frames);
  frames.push_back(last);
  sort_unique(frames);
  const std::vector<int> coarse = frames;
  int before = 0;
  for (const int frame : coarse) {
    subdivide(target, before, frame, options.tolerance, frames);
    before = frame;
  }
  sort_unique(frames);
  return frames;
}

std::vector<int> merged_knots(std::span<const int> a, std::span<const int> b) {
  std::vector<int> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  sort_unique(all);
  return all;
}

double shortest_horizon_s(double tick_s) { return std::max(0.1, 3.0 * tick_s); }

double horizon_s(std::span<const int> knots, double frame, double rate_hz, double tick_s) {
  const auto next = std::ranges::upper_bound(knots, frame, {}, [](int knot) { return static_cast<double>(knot); });
  const double shortest_s = shortest_horizon_s(tick_s);
  if (next == knots.end()) return std::max(kHold_s, shortest_s);
  const double ahead_s = (*next - frame) / rate_hz;
  return ahead_s > kFarthest_s ? std::max(kHold_s, shortest_s) : std::max(ahead_s, shortest_s);
}

}  // namespace contort
