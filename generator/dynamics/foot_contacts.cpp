#include "generator/dynamics/foot_contacts.h"

#include <algorithm>

#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kRootEase = 1e3;        // against a joint's 1: the root goes where the legs say
constexpr double kFootStiffness = 15.0;  // rad/s, of soles that have drifted
constexpr double kLandingGap_m = 0.03;   // a sole that is meant to stand and is nearer than this has landed

}  // namespace

void FootContacts::begin(const DynamicFigure& figure, const Environment& environment, std::vector<std::uint8_t> plan,
                         double rate_hz) {
  figure_ = &figure;
  environment_ = &environment;
  plan_ = std::move(plan);
  rate_hz_ = rate_hz;
  feet_.begin(figure);
  ease_.assign(at(figure.body.dof_count()), 1.0);
  std::fill_n(ease_.begin(), kRootDofs, kRootEase);
  firmness_.assign(figure.soles.size(), 1.0);
  begin_frame(0);
}

void FootContacts::begin_frame(int frame) {
  frame_ = frame;
  soften(*figure_, plan_, frame, rate_hz_, firmness_, ease_);
}

bool FootContacts::follow_plan(const DynamicsScratch& dynamics, bool at_once) {
  bool changed = false;
  for (int i = 0; i < sole_count(); ++i) {
    const bool stands = feet_.stands(i), shall = is_planned(i);
    const bool lands = shall && !stands && (at_once || gap_m(sole(i), dynamics, *environment_) < kLandingGap_m);
    if (stands && !shall) feet_.lift(i);
    if (lands) land(i, dynamics);
    changed = changed || lands || (stands && !shall);
  }
  return changed;
}

bool FootContacts::land_flat(const DynamicsScratch& dynamics) {
  for (int i = 0; i < sole_count(); ++i)
    if (is_planned(i) && lies_still(sole(i), dynamics, *environment_)) land(i, dynamics);
  return !feet_.none();
}

void FootContacts::find_rows(EquationOfMotion& equation) {
  equation.find_bias();
  support_rows(equation.body(), feet_.places(), equation.state.velocity, kFootStiffness, kGravity_m_s2,
               equation.dynamics, support_);
}

void FootContacts::land(int index, const DynamicsScratch& dynamics) {
  feet_.land(index, footprint(sole(index), dynamics, *environment_));
}

}  // namespace contort
