#include "checks/lone_steps.h"

#include <algorithm>
#include <limits>

#include "checks/pop.h"

namespace contort {

namespace {

constexpr int kFewestOthers = 4;
constexpr double kAnyStep = std::numeric_limits<double>::infinity();
constexpr double kSlack_s = 1e-4;  // files store times as 32-bit numbers

// The greatest steps around some intervals: in the intervals beside them, and in all others nearby.
struct Around {
  double beside = 0.0;
  double farther = 0.0;
  int count = 0;

  double greatest() const { return std::max(beside, farther); }
};

class StepsOfChannel {
 public:
  StepsOfChannel(std::span<const SpeedInterval> between_keys, FunctionRef<double(std::size_t, std::size_t)> apart)
      : v_(between_keys), apart_(apart) {
    for (std::size_t i = 0; i < v_.size(); ++i) steps_.push_back(apart(i, i + 1));
  }

  double step(std::size_t i) const { return steps_[i]; }
  double net(std::size_t i, std::size_t j) const { return apart_(i, j + 1); }
  double duration_s(std::size_t i, std::size_t j) const { return v_[j].t1_s - v_[i].t0_s; }

  // Intervals between i and j count as beside both.
  Around around(std::size_t i, std::size_t j) const {
    Around out;
    const double length_s = std::max(duration_s(i, i), duration_s(j, j));
    for (std::size_t k = i; k-- > 0 && v_[k].t0_s >= v_[i].t0_s - kLoneAround_s - kSlack_s;)
      add(step_in(k, length_s), k + 1 == i, out);
    for (std::size_t k = i + 1; k < j; ++k) add(step_in(k, length_s), true, out);
    for (std::size_t k = j + 1; k < v_.size() && v_[k].t1_s <= v_[j].t1_s + kLoneAround_s + kSlack_s; ++k)
      add(step_in(k, length_s), k == j + 1, out);
    return out;
  }

 private:
  static void add(double step, bool is_beside, Around& out) {
    double& greatest = is_beside ? out.beside : out.farther;
    greatest = std::max(greatest, step);
    ++out.count;
  }

  // The step that the same speed makes in an interval of this length. The step of a shorter interval is not scaled.
  double step_in(std::size_t k, double length_s) const {
    const double own_s = duration_s(k, k);
    return own_s > length_s ? steps_[k] * length_s / own_s : steps_[k];
  }

  std::span<const SpeedInterval> v_;
  FunctionRef<double(std::size_t, std::size_t)> apart_;
  std::vector<double> steps_;
};

double allowed_jump(const StepsOfChannel& steps, std::size_t i, double least) {
  const Around around = steps.around(i, i);
  if (around.count < kFewestOthers) return kAnyStep;
  return std::max({least, kBlipFactor * around.beside, kJumpFactor * around.farther});
}

// The largest step for a joint that leaves its place in interval i and comes back in interval j.
double allowed_blip(const StepsOfChannel& steps, std::size_t i, std::size_t j, double least) {
  const Around around = steps.around(i, j);
  if (around.count < kFewestOthers) return kAnyStep;
  return std::max({least, kBlipFactor * around.greatest(), 2.0 * steps.net(i, j)});
}

void judge_blips(const StepsOfChannel& steps, std::size_t i, std::size_t count, double least,
                 std::vector<double>& allowed) {
  for (std::size_t j = i + 1; j < count && steps.duration_s(i, j) <= kLongestBlip_s + kSlack_s; ++j) {
    const double smaller = std::min(steps.step(i), steps.step(j));
    if (!(smaller > least)) continue;
    const double most = allowed_blip(steps, i, j, least);
    if (!(smaller > most)) continue;
    allowed[i] = std::min(allowed[i], most);
    allowed[j] = std::min(allowed[j], most);
  }
}

}  // namespace

LoneLimits lone_limits(Interpolation interpolation, const LoneLimits& limits) {
  return {limits.blip, interpolation == Interpolation::step ? kAnyStep : limits.jump};
}

std::vector<double> allowed_lone_steps(std::span<const SpeedInterval> between_keys,
                                       FunctionRef<double(std::size_t, std::size_t)> apart, const LoneLimits& limits) {
  const StepsOfChannel steps(between_keys, apart);
  std::vector<double> allowed(between_keys.size(), kAnyStep);
  for (std::size_t i = 0; i < between_keys.size(); ++i) {
    if (steps.duration_s(i, i) > kPopLongest_s) continue;
    if (steps.step(i) > limits.jump) allowed[i] = std::min(allowed[i], allowed_jump(steps, i, limits.jump));
    judge_blips(steps, i, between_keys.size(), limits.blip, allowed);
  }
  return allowed;
}

}  // namespace contort
