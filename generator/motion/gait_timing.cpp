#include "generator/motion/gait_timing.h"

#include <algorithm>
#include <cmath>

namespace contort {

namespace {

constexpr double kBodyHeight = 1.08;  // of the centre of mass, in legs

// The integral of a speed that rises along 3u^2 - 2u^3 to 1 within ramp_s.
double ramped_s(double time_s, double ramp_s) {
  const double u = ramp_s > 0.0 ? std::clamp(time_s / ramp_s, 0.0, 1.0) : 1.0;
  return ramp_s * (u * u * u - 0.5 * u * u * u * u) + std::max(0.0, time_s - ramp_s);
}

double ramp(double u) { return u * u * (3.0 - 2.0 * u); }

// The integral of a speed that rises to 1 within up_s, and falls to 0 within down_s before end_s.
double eased_s(double time_s, double end_s, double up_s, double down_s) {
  const double t = std::clamp(time_s, 0.0, end_s);
  if (t <= end_s - down_s) return ramped_s(t, up_s);
  return ramped_s(end_s - down_s, up_s) + ramped_s(down_s, down_s) - ramped_s(end_s - t, down_s);
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
  // Friction and balance bound how quickly a figure gets faster or slower.
  const double ramp_s = std::max(0.6 * params.cycle_s, params.speed_m_s / params.acceleration_m_s2);
  up_s_ = std::min(std::max(wanted_s, ramp_s), 0.6 * moving_s_);
  down_s_ = std::min(ramp_s, moving_s_ - up_s_);
  const double hurry = wanted_s / std::max(up_s_, 1e-9);  // above 1 on a way too short for the speed
  if (hurry > 1.0) speed_m_s_ /= hurry * hurry;
  pendulum_s2_ = params.leads * kBodyHeight * least_length_m(legs) / 9.81;
  // Feet turn with the body, step by step.
  const double most_rad_s = params.turn_of_cycle_rad / params.cycle_s;
  turn_s_ = params.turn_rad == 0.0 ? 0.0 : std::min(moving_s_, std::fabs(params.turn_rad) / most_rad_s + turn_ramp_s());
  const double most_rad = most_rad_s * std::max(0.0, turn_s_ - turn_ramp_s());
  turn_rad_ = std::clamp(params.turn_rad, -most_rad, most_rad);
}

double GaitTiming::phase(const Leg& leg) const {
  const int side = leg.side == params_.lead ? 0 : 1;
  if (params_.trot) return 0.5 * ((side + leg.row) % 2) - params_.wait;
  return 0.5 * side + 0.5 * leg.row / rows_ - params_.wait;
}

double GaitTiming::since_landing(const Leg& leg, double time_s) const {
  const double cycles = time_s / params_.cycle_s + phase(leg);
  return cycles - std::floor(cycles);
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

double GaitTiming::lands_s(const Leg& leg, int step) const { return (step - phase(leg)) * params_.cycle_s; }

double GaitTiming::lifted_s(const Leg& leg, int step) const {
  return (step + params_.duty - phase(leg)) * params_.cycle_s;
}

double GaitTiming::middle_s(const Leg& leg, int step) const {
  return (step + params_.under * params_.duty - phase(leg)) * params_.cycle_s;
}

double GaitTiming::travelled_m(double time_s) const {
  return speed_m_s_ * eased_s(time_s, moving_s_, up_s_, down_s_);
}

double GaitTiming::speed_m_s(double time_s) const {
  if (time_s <= 0.0 || time_s >= moving_s_) return 0.0;
  const double rise = up_s_ > 0.0 ? ramp(std::min(1.0, time_s / up_s_)) : 1.0;
  const double fall = down_s_ > 0.0 ? ramp(std::min(1.0, (moving_s_ - time_s) / down_s_)) : 1.0;
  return speed_m_s_ * std::min(rise, fall);
}

double GaitTiming::leads_m(double time_s) const {
  const double quarter_s = 0.25 * params_.cycle_s;
  return pendulum_s2_ * (speed_m_s(time_s + quarter_s) - speed_m_s(time_s - quarter_s)) / (2.0 * quarter_s);
}

double GaitTiming::turned(double time_s) const {
  if (turn_s_ <= 0.0) return 1.0;
  const double ramp_s = std::min(turn_ramp_s(), 0.5 * turn_s_);
  return eased_s(time_s, turn_s_, ramp_s, ramp_s) / eased_s(turn_s_, turn_s_, ramp_s, ramp_s);
}

double GaitTiming::step_share(double time_s) const {
  const double quarter_s = 0.25 * params_.cycle_s;
  const double way_m = travelled_m(time_s + quarter_s) - travelled_m(time_s - quarter_s);
  return way_m / std::max(2.0 * quarter_s * params_.speed_m_s, 1e-6);
}

}  // namespace contort
