#include "generator/motion/low_pass.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/core/math.h"

namespace contort {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Vec3 median(const std::vector<Vec3>& values) {
  Vec3 best(0.0);
  double least_m = std::numeric_limits<double>::infinity();
  for (const Vec3& one : values) {
    double sum_m = 0.0;
    for (const Vec3& other : values) sum_m += length(one - other);
    if (sum_m < least_m) least_m = sum_m, best = one;
  }
  return best;
}

namespace {

constexpr double kTail = 4.0;      // standard deviations on either side
constexpr double kJump_s = 0.05;   // a jump takes at most this
constexpr double kSpread_hz = 1.5; // with this cutoff the ways of jumps are spread over time

struct JumpFilter {
  double rate_hz = 60.0;
  std::vector<double> weights;  // of the filter that spreads what jumps were worth
};

// Weights of a frame and of those after it, one side; both sides together sum to 1.
std::vector<double> gaussian(double cutoff_hz, double rate_hz) {
  // |H(f)| = exp(-(2 pi f s)^2 / 2) is 1 / sqrt 2 at the cutoff: 2 pi f s = sqrt(ln 2).
  constexpr double kRootOfLn2 = 0.83255461115769776;
  const double sigma = kRootOfLn2 / (2.0 * kPi * cutoff_hz) * rate_hz;
  std::vector<double> weights = {1.0};
  for (int k = 1; k <= kTail * sigma; ++k) weights.push_back(det::exp(-0.5 * k * k / (sigma * sigma)));
  double sum = 1.0;
  for (std::size_t k = 1; k < weights.size(); ++k) sum += 2.0 * weights[k];
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Frames are addressed from -count + 1 to 2 * count - 2: those outside are mirror images.
template <typename Value>
Value mirrored(const Value& end, const Value& value) { return 2.0 * end - value; }
Quat mirrored(const Quat& end, const Quat& q) { return end * glm::conjugate(q) * end; }

template <typename Value>
Value value_at(const std::vector<Value>& values, int frame) {
  const int last = static_cast<int>(values.size()) - 1;
  if (frame < 0) return mirrored(values.front(), values[at(std::min(-frame, last))]);
  if (frame > last) return mirrored(values.back(), values[at(std::max(2 * last - frame, 0))]);
  return values[at(frame)];
}

template <typename Value>
std::vector<Value> filtered(const std::vector<double>& weights, const std::vector<Value>& values) {
  std::vector<Value> out;
  for (int f = 0; f < static_cast<int>(values.size()); ++f) {
    Value sum = weights[0] * values[at(f)];
    for (int k = 1; k < static_cast<int>(weights.size()); ++k)
      sum += weights[at(k)] * (value_at(values, f - k) + value_at(values, f + k));
    out.push_back(sum);
  }
  return out;
}

// The mean of the rotations that lead from a frame to those around it.
std::vector<Quat> filtered(const std::vector<double>& weights, const std::vector<Quat>& values) {
  std::vector<Quat> out;
  for (int f = 0; f < static_cast<int>(values.size()); ++f) {
    const Quat back = glm::conjugate(values[at(f)]);
    Vec3 sum(0.0);
    for (int k = 1; k < static_cast<int>(weights.size()); ++k)
      for (const int other : {f - k, f + k}) sum += weights[at(k)] * to_rotation_vector(back * value_at(values, other));
    out.push_back(glm::normalize(values[at(f)] * from_rotation_vector(sum)));
  }
  return out;
}

template <typename Value>
std::vector<Value> medians_of(const std::vector<Value>& values, double rate_hz) {
  std::vector<Value> out;
  const int last = static_cast<int>(values.size()) - 1, reach = static_cast<int>(std::ceil(kJump_s * rate_hz));
  for (int f = 0; f <= last; ++f) {
    const int r = std::min({reach, f, last - f});
    out.push_back(median(std::vector<Value>(values.begin() + f - r, values.begin() + f + r + 1)));
  }
  return out;
}

// The way from one value to another, and the value at the end of a way.
template <typename Value>
Value way_to(const Value& from, const Value& to) { return to - from; }
Vec3 way_to(const Quat& from, const Quat& to) { return to_rotation_vector(glm::conjugate(from) * to); }
template <typename Value>
Value gone(const Value& from, const Value& way) { return from + way; }
Quat gone(const Quat& from, const Vec3& way) { return glm::normalize(from * from_rotation_vector(way)); }

template <typename Value>
std::vector<Value> without_jumps(const JumpFilter& filter, const std::vector<Value>& values) {
  using Way = decltype(way_to(values[0], values[0]));
  std::vector<Way> steps, missing;
  std::vector<Value> even = {values.front()};
  for (std::size_t f = 1; f < values.size(); ++f) steps.push_back(way_to(values[f - 1], values[f]));
  for (const Way& step : medians_of(steps, filter.rate_hz)) even.push_back(gone(even.back(), step));
  for (std::size_t f = 0; f < values.size(); ++f) missing.push_back(way_to(even[f], values[f]));
  missing = filtered(filter.weights, missing);
  for (std::size_t f = 0; f < values.size(); ++f) even[f] = gone(even[f], missing[f]);
  return even;
}

void put_quat(const Quat& q, double* to) { to[0] = q.w, to[1] = q.x, to[2] = q.y, to[3] = q.z; }

// Replaces the values of one joint, or of the root, by frame.
template <typename Value, typename Filter, typename Get, typename Set>
void filter_values(int frames, const Filter& filter, const Get& get, const Set& set) {
  std::vector<Value> values;
  for (int f = 0; f < frames; ++f) values.push_back(get(f));
  values = filter(values);
  for (int f = 0; f < frames; ++f) set(f, values[at(f)]);
}

// Filters every joint and the root.
template <typename Filter>
void filter_motion(const Character& character, const Filter& filter, Motion& motion) {
  const auto root = [&](int f) -> Rigid& { return motion.root[at(f)]; };
  const int n = motion.frame_count;
  filter_values<Vec3>(n, filter, [&](int f) { return root(f).p_m; }, [&](int f, const Vec3& p) { root(f).p_m = p; });
  filter_values<Quat>(n, filter, [&](int f) { return root(f).q; }, [&](int f, const Quat& q) { root(f).q = q; });
  for (const Joint& joint : character.joints()) {
    const auto coord = [&](int f) { return &motion.row(f)[at(joint.coord)]; };
    if (coord_size(joint.kind) == 1)
      filter_values<double>(n, filter, [&](int f) { return *coord(f); }, [&](int f, double v) { *coord(f) = v; });
    if (coord_size(joint.kind) == 4)
      filter_values<Quat>(
          n, filter, [&](int f) { return quat_at(coord(f)); }, [&](int f, const Quat& q) { put_quat(q, coord(f)); });
  }
}

}  // namespace

std::vector<Vec3> medians(const std::vector<Vec3>& values, double rate_hz) { return medians_of(values, rate_hz); }

void remove_jumps(const Character& character, Motion& motion) {
  const JumpFilter filter{motion.rate_hz, gaussian(kSpread_hz, motion.rate_hz)};
  filter_motion(character, [&](const auto& values) { return without_jumps(filter, values); }, motion);
}

void low_pass(const Character& character, double cutoff_hz, Motion& motion) {
  const std::vector<double> weights = gaussian(cutoff_hz, motion.rate_hz);
  filter_motion(character, [&](const auto& values) { return filtered(weights, values); }, motion);
}

}  // namespace contort
