#include "generator/dynamics/steering.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kReturn_per_s = 3.0;  // of the capture point
constexpr double kLeastHeight_m = 0.2;

Vec3 between(const std::vector<Vec3>& values, double frame) {
  const double last = static_cast<double>(values.size()) - 1.0;
  const double clamped = std::clamp(frame, 0.0, last);
  const auto before = static_cast<std::size_t>(clamped);
  const std::size_t after = std::min(before + 1, values.size() - 1);
  return values[before] + (clamped - static_cast<double>(before)) * (values[after] - values[before]);
}

double pendulum_per_s(double height_m) { return std::sqrt(kGravity_m_s2 / std::max(height_m, kLeastHeight_m)); }

}  // namespace

Vec3 Steering::capture_m(double frame, const EquationOfMotion& equation) const {
  const SpatialInertia& whole = equation.dynamics.composite[0];
  const Vec3 com_m = equation.state.root.p_m + whole.first_moment.narrow() / whole.mass_kg;
  Vec3 speed(0.0);
  for (const int k : {0, 2})
    speed[k] =
        dot(std::span(equation.mass).subspan(at(k) * equation.size(), equation.size()), equation.state.velocity) /
        whole.mass_kg;
  return com_m + speed / pendulum_per_s(com_m.y - between(plan_->zmp_m, frame).y);
}

Vec3 Steering::ahead_m(double frame, const Vec3& shift_m, const EquationOfMotion& equation) const {
  const Vec3 com_m = between(plan_->com_m, frame);
  const double w = pendulum_per_s(com_m.y - between(plan_->zmp_m, frame).y);
  Vec3 ahead = capture_m(frame, equation) - shift_m - com_m - between(plan_->com_m_s, frame) / w;
  ahead.y = 0.0;
  return ahead;
}

Vec3 Steering::zmp_m(double frame, const Vec3& shift_m, const EquationOfMotion& equation) const {
  const Vec3 planned = between(plan_->zmp_m, frame);
  const double w = pendulum_per_s(between(plan_->com_m, frame).y - planned.y);
  return planned + shift_m + (1.0 + kReturn_per_s / w) * ahead_m(frame, shift_m, equation);
}

}  // namespace contort
