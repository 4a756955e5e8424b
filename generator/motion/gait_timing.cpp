#include "generator/motion/gait_timing.h"

#include <algorithm>
#include <cmath>

namespace contort {

namespace {

// The integral of a speed that rises along 3u^2 - 2u^3 to 1 within ramp_s.
double ramped_s(double time_s, double ramp_s) {
  const double u = ramp_s > 0.0 ? std::clamp(time_s / ramp_s, 0.0, 1.0) : 1.0;
  return ramp_s * (u * u * u - 0.5 * u * u * u * u) + std::max(0.0, time_s - ramp_s);
}

}  // namespace

// The root begins so slowly that no foot is left behind at home by more than half a stance before its first swing: a
// way of ramp u^3 with u = lift / ramp, at most.
GaitTiming::GaitTiming(const GaitParams& params, std::span<const Leg> legs, double duration_s)
    : params_(params), rows_(row_count(legs)), speed_m_s_(params.speed_m_s) {
  moving_s_ = std::max(duration_s - params.cycle_s, 0.5 * duration_s);
  double lift_s = 0.0;
  for (const Leg& leg : legs) lift_s = std::max(lift_s, first_lift_s(leg));
  const double half_stance_s = 0.5 * params.duty * params.cycle_s;
  const double wanted_s = std::sqrt(lift_s * lift_s * lift_s / half_stance_s);
  up_s_ = std::min(std::max(wanted_s, 0.6 * params.cycle_s), 0.6 * moving_s_);
  down_s_ = std::min(0.6 * params.cycle_s, moving_s_ - up_s_);
  const double hurry = wanted_s / std::max(up_s_, 1e-9);  // above 1 on a way too short for the speed
  if (hurry > 1.0) speed_m_s_ /= hurry * hurry;
}

double GaitTiming::phase(const Leg& leg) const {
  const int side = leg.side == params_.lead ? 0 : 1;
  if (params_.trot) return 0.5 * ((side + leg.row) % 2);
  return 0.5 * side + 0.5 * leg.row / rows_;
}

FootCycle GaitTiming::cycle(const Leg& leg, double time_s) const {
  const double cycles = time_s / params_.cycle_s + phase(leg);
  const double whole = std::floor(cycles + 1e-9);
  const double within = std::max(0.0, cycles - whole);
  const double swing = (within - params_.duty) / (1.0 - params_.duty);
  return {static_cast<int>(whole), std::min(within / params_.duty, 1.0), std::clamp(swing, 0.0, 1.0)};
}

// When a leg's first swing begins.
double GaitTiming::first_lift_s(const Leg& leg) const {
  const double cycles = params_.duty - phase(leg);
  return (cycles < 0.0 ? cycles + 1.0 : cycles) * params_.cycle_s;
}

double GaitTiming::lifted_s(const Leg& leg, int step) const {
  return (step + params_.duty - phase(leg)) * params_.cycle_s;
}

double GaitTiming::middle_s(const Leg& leg, int step) const {
  return (step + params_.under * params_.duty - phase(leg)) * params_.cycle_s;
}

double GaitTiming::travelled_m(double time_s) const {
  const double t = std::clamp(time_s, 0.0, moving_s_);
  if (t <= moving_s_ - down_s_) return speed_m_s_ * ramped_s(t, up_s_);
  const double whole = ramped_s(moving_s_ - down_s_, up_s_) + ramped_s(down_s_, down_s_);
  return speed_m_s_ * (whole - ramped_s(moving_s_ - t, down_s_));
}

double GaitTiming::step_share(double time_s) const {
  const double quarter_s = 0.25 * params_.cycle_s;
  const double way_m = travelled_m(time_s + quarter_s) - travelled_m(time_s - quarter_s);
  return way_m / std::max(2.0 * quarter_s * params_.speed_m_s, 1e-6);
}

}  // namespace contort
