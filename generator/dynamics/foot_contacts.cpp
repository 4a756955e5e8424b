#include "generator/dynamics/foot_contacts.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kEase = 1e3;  // of what gives way, the root or the legs, against 1 of all others
constexpr double kPlanted_s = 0.25;
constexpr double kFootStiffness = 15.0;  // rad/s, of soles that have drifted
constexpr double kTouching_m = 0.02;     // a corner that is higher than this above the ground does not bear

SoleMotion moved(const Rigid& offset, const SoleMotion& motion) {
  return {offset * motion.world_from_sole, offset.q * motion.linear, offset.q * motion.angular};
}

}  // namespace

void FootContacts::begin(const DynamicFigure& figure, const Environment& environment, const ContactPlan& plan,
                         double rate_hz, double tick_s) {
  figure_ = &figure;
  environment_ = &environment;
  plan_ = &plan;
  rate_hz_ = rate_hz, tick_s_ = tick_s;
  is_led_ = false;
  stances_.clear();
  for (int f = 0; f < plan.frame_count(); ++f) stances_.push_back(plan.standing(f));
  offsets_.assign(figure.soles.size(), Rigid{});
  led_.clear();
  feet_.begin(figure);
  ease_.assign(at(figure.body.dof_count()), 1.0);
  led_by_dof_.assign(ease_.size(), 0);
  for (const Sole& own : figure.soles)
    for (const int dof : own.leg_dofs) led_by_dof_[at(dof)] = 1;
  firmness_.assign(figure.soles.size(), 1.0);
  find_planted();
  begin_frame(0);
}

void FootContacts::find_planted() {
  const int count = plan_->frame_count(), around = static_cast<int>(kPlanted_s * rate_hz_);
  planted_.assign(at(count), 1);
  for (int f = 0; f < count; ++f)
    for (int i = 0; i < sole_count(); ++i) {
      if (plan_->bearing(f, i).corners == kAllCorners) continue;
      for (int k = std::max(0, f - around); k <= std::min(count - 1, f + around); ++k) planted_[at(k)] = 0;
    }
}

void FootContacts::begin_frame(int frame) {
  frame_ = frame;
  for (std::size_t k = 0; k < ease_.size(); ++k) {
    const bool gives = is_planted() ? k < kRootDofs : led_by_dof_[k] != 0;
    ease_[k] = gives ? kEase : 1.0;
  }
  for (int i = 0; i < sole_count(); ++i) {
    const double firm = contort::firmness(stances_, i, frame, rate_hz_);
    firmness_[at(i)] = firm * firm;
  }
}

LedSole FootContacts::led_at(int index, double frame) const {
  const Rigid& offset = offsets_[at(index)];
  SoleMotion goal = plan_->sole_at(frame, index);
  // As lead_joint() of tracker.cpp: the rate that a sole has is that of half a tick ago.
  const SoleMotion before = plan_->sole_at(frame - 0.5 * tick_s_ * rate_hz_, index);
  goal.linear = before.linear, goal.angular = before.angular;
  LedSole led{sole(index).link, sole(index).link_from_sole, moved(offset, goal)};
  plan_->acceleration_at(frame, index, led.linear_m_s2, led.angular_rad_s2);
  led.linear_m_s2 = offset.q * led.linear_m_s2, led.angular_rad_s2 = offset.q * led.angular_rad_s2;
  return led;
}

Bearing FootContacts::bearing(int index, const DynamicsScratch& dynamics) const {
  Bearing planned = plan_->bearing(frame_, index);
  if (planned.corners == 0) return planned;
  const Placement& link = dynamics.world[at(sole(index).link)];
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 point = link.origin_m + link.rotation * sole(index).corners_m[k];
    if (environment_->nearest_ground(point).distance_m > kTouching_m)
      planned.corners &= static_cast<std::uint8_t>(~(1U << k));
  }
  return planned;
}

void FootContacts::follow_plan(double frame, const DynamicsScratch& dynamics) {
  led_.clear();
  for (int i = 0; i < sole_count() && is_led_; ++i) {
    led_.push_back(led_at(i, frame));
    feet_.put(i, bearing(i, dynamics));
  }
}

bool FootContacts::land_flat(double frame, const DynamicsScratch& dynamics) {
  bool any = false;
  for (int i = 0; i < sole_count(); ++i) {
    if (!is_planned(i) || !lies_still(sole(i), dynamics, *environment_)) continue;
    const Rigid place = footprint(sole(i), dynamics, *environment_);
    offsets_[at(i)] = place * inverse(plan_->sole(frame_, i));
    if (!any) std::ranges::fill(offsets_, offsets_[at(i)]);
    any = true;
  }
  if (!any) return false;
  is_led_ = true;
  follow_plan(frame, dynamics);
  if (feet_.none()) release();
  return is_led_;
}

void FootContacts::release() {
  is_led_ = false;
  led_.clear();
  feet_.clear();
}

Vec3 FootContacts::shift_m() const {
  Vec3 sum(0.0);
  for (const int i : feet_.soles()) {
    const Vec3& planned = plan_->sole(frame_, i).p_m;
    sum += offsets_[at(i)] * planned - planned;
  }
  sum.y = 0.0;
  return feet_.none() ? sum : sum / static_cast<double>(feet_.soles().size());
}

void FootContacts::stop(EquationOfMotion& equation) {
  std::vector<double>& wanted = support_.wanted;
  soles_moved_by(support_, equation.state.velocity, wanted);
  for (double& speed : wanted) speed = -speed;
  change_.assign(equation.size(), 0.0);
  respond(equation.body(), equation.factors, support_, wanted, response_, change_);
  add_scaled(1.0, change_, equation.state.velocity);
}

int FootContacts::swinging(int dof) const {
  for (int i = 0; i < static_cast<int>(led_.size()); ++i)
    if (!feet_.stands(i) && std::ranges::find(sole(i).leg_dofs, dof) != sole(i).leg_dofs.end()) return i;
  return -1;
}

void FootContacts::ask_less(int index, double share, std::span<const double> acceleration) {
  std::vector<double>&passive = passive_, &moved = moved_;
  passive.assign(acceleration.begin(), acceleration.end());
  moved.resize(at(support_.count));
  for (const int dof : sole(index).leg_dofs) passive[at(dof)] = 0.0;
  soles_moved_by(support_, passive, moved);
  for (std::size_t r = at(6 * index); r < at(6 * index + 6); ++r)
    support_.wanted[r] = moved[r] + share * (support_.wanted[r] - moved[r]);
}

void FootContacts::find_rows(EquationOfMotion& equation, std::span<const double> tracked,
                             std::span<const DofEnd> ends) {
  equation.find_bias();
  middle_ = equation.state.velocity;
  add_scaled(0.5 * tick_s_, tracked, middle_);
  still_.clear();
  find_rows_with(equation, still_);
  if (ends.empty()) return;
  probe_.assign(tracked.begin(), tracked.end());
  keep(probe_);
  for (const DofEnd& end : ends)
    if (end.out * probe_[at(end.dof)] > 0.0) still_.push_back(end.dof);
  if (!still_.empty()) find_rows_with(equation, still_);
}

void FootContacts::find_rows_with(const EquationOfMotion& equation, std::span<const int> still_dofs) {
  support_rows(equation.body(), led_, middle_, still_dofs, kFootStiffness, 0.5 * tick_s_, equation.dynamics, support_);
  prepare_projection(ease_, support_);
}

}  // namespace contort
