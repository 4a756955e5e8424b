#include "generator/dynamics/standing.h"

#include <algorithm>

#include "generator/dynamics/linear.h"
#include "generator/dynamics/strength.h"
#include "generator/dynamics/support_hull.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kEdge_m = 0.005;           // of the zero moment point from the edge, for which tracking gives way
constexpr double kYields = 1e3;             // against others' 1: an arm's joint that is overloaded lags by itself
constexpr double kStandingPressure = 0.25;  // of the weight, on feet that stand
constexpr int kAttempts = 6;                // to spare joints,
constexpr int kAskedOfSwing = 2;            // the first of them by feet in the air
constexpr double kMostOfLoad = 0.7;         // of the ground's force, on a sole that decides where the figure stands
constexpr double kLost_m = 0.3;             // a capture point this far outside is not brought back by standing feet
constexpr double kCatches_m = 0.02;         // but one this near is by feet that have just landed
constexpr double kTips_m = 0.03;            // the zero moment point this far outside cannot be brought back
constexpr double kTips_s = 0.2;             // nor one that is outside for so long

}  // namespace

void Standing::begin(const DynamicFigure& figure, const BalancePlan& plan, double tick_s) {
  steering_.begin(plan);
  tick_s_ = tick_s;
  outside_s_ = 0.0;
  control_.begin(figure, tick_s);
  zeros_.assign(at(figure.body.dof_count()), 0.0);
  hold_.assign(at(figure.body.dof_count()));
}

void Standing::let_go() {
  control_.rest();
  outside_s_ = 0.0;
}

void Standing::find_ground(const EquationOfMotion& equation, const FootContacts& contacts,
                           const Actuation& actuation) {
  find_support_area(*equation.figure, contacts.feet(), std::max(actuation.forces[1], 0.5 * equation.weight_N()),
                    equation.dynamics, area_);
  ground_.prepare(*equation.figure, contacts.feet(), contacts.firmness(), equation.dynamics);
}

Balance Standing::balance(const EquationOfMotion& equation, std::span<const double> forces) const {
  return balance_of(area_, equation.dynamics, forces, equation.weight_N());
}

bool Standing::stand(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted,
                     std::span<const DofEnd> ends, Recorder& record, Actuation& actuation) {
  contacts.find_rows(equation, wanted, ends);
  bool is_strong = false, can_try = true;
  zmp_m_ = Vec3(0.0), has_zmp_ = false, spared_.clear(), asked_ = 0;
  ease_.assign(contacts.ease().begin(), contacts.ease().end());
  for (int attempt = 0; attempt < kAttempts && !is_strong && can_try; ++attempt) {
    follow(equation, contacts, wanted, attempt == 0, actuation);
    is_strong = !exceeds_strength(*equation.figure, actuation.efforts);
    can_try = is_strong || relieve(equation, contacts, actuation);
  }
  if (!is_strong) hold_back(equation, contacts, record, actuation);
  if (contacts.feet().none()) return true;
  const Balance reached = balance(equation, actuation.forces);
  record.balance(reached);
  outside_s_ = reached.margin_m < 0.0 ? outside_s_ + tick_s_ : 0.0;
  return reached.margin_m > -kTips_m && outside_s_ < kTips_s && lost_m(equation, contacts) < kLost_m;
}

// The distance of the capture point from the support area, m, as far as it is not meant to be there: in a walk it runs
// ahead.
double Standing::lost_m(const EquationOfMotion& equation, const FootContacts& contacts) {
  corners_m_ = area_.corners_m;
  const Vec3 capture_m = steering_.capture_m(frame_, equation);
  return std::min(length(capture_m - nearest_inside(corners_m_, 0.0, capture_m, hull_)),
                  length(steering_.ahead_m(frame_, contacts.shift_m(), equation)));
}

// The accelerations nearest to the wanted ones that lead the soles, ask of the ground what it can give, and spare the
// joints that have been found to be overloaded.
void Standing::follow(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted, bool first,
                      Actuation& actuation) {
  std::ranges::copy(wanted, actuation.acceleration.begin());
  contacts.keep(actuation.acceleration);
  equation.find_forces(actuation.acceleration, actuation.forces);
  if (first) find_ground(equation, contacts, actuation);
  if (is_disturbed_ && first)
    control_.correct({*equation.figure, equation.dynamics, equation.mass, contacts.led_by_dof(), contacts.support(),
                      area_, ground_, equation.weight_N(), actuation.acceleration, actuation.forces});
  if (is_disturbed_ && !first) {
    add_scaled(1.0, control_.added(), actuation.acceleration);
    equation.find_forces(actuation.acceleration, actuation.forces);
  }
  find_rows(equation, contacts, actuation);
  meet(equation, contacts, actuation);
  find_efforts(equation, actuation);
}

void Standing::find_efforts(const EquationOfMotion& equation, Actuation& actuation) {
  ground_.follow_load(equation.dynamics, actuation.forces);
  ground_.efforts(equation.dynamics, actuation.forces, actuation.efforts);
}

// The base's accelerations with these conditions; one more where the ground would press too little for the feet to
// stay.
void Standing::meet(const EquationOfMotion& equation, FootContacts& contacts, Actuation& actuation) {
  base_.acceleration = actuation.acceleration, base_.forces = actuation.forces;
  if (!rows_.empty()) ground_control_.meet(equation, ease_, rows_, contacts.support(), actuation);
  const double least_N = kStandingPressure * equation.weight_N();
  if (contacts.feet().none() || actuation.forces[1] >= least_N) return;
  actuation.acceleration = base_.acceleration, actuation.forces = base_.forces;
  add_pressure_row(least_N, rows_);
  ground_control_.meet(equation, ease_, rows_, contacts.support(), actuation);
}

// Conditions on forces: no force in flight, a zero moment point that the support area has, and joints that are spared.
void Standing::find_rows(const EquationOfMotion& equation, const FootContacts& contacts, const Actuation& actuation) {
  rows_.clear();
  if (!contacts.has_soles()) return;
  if (contacts.feet().none()) return add_flight_rows(rows_);
  if (!has_zmp_ && balance(equation, actuation.forces).margin_m < kEdge_m) {
    corners_m_ = area_.corners_m;
    zmp_m_ = nearest_inside(corners_m_, kEdge_m, steering_.zmp_m(frame_, contacts.shift_m(), equation), hull_);
    has_zmp_ = true;
  }
  if (has_zmp_) add_zmp_rows(equation.dynamics.world[0], zmp_m_, rows_);
  for (const auto& [dof, effort] : spared_) add_effort_row(ground_, equation.dynamics, dof, effort, zeros_, rows_);
}

// Returns true if any foot is in the air, which then comes later.
bool Standing::ask_less_of_swing(FootContacts& contacts, double share, const Actuation& actuation) {
  bool any = false;
  for (int i = 0; i < contacts.sole_count(); ++i) {
    if (contacts.feet().stands(i)) continue;
    contacts.ask_less(i, share, actuation.acceleration);
    any = true;
  }
  return any;
}

// The sole that bears most of the weight if this is one of its ankle's degrees of freedom, or -1.
int Standing::carried_by(const EquationOfMotion& equation, const FootContacts& contacts, const Actuation& actuation,
                         int dof) const {
  const SpatialForce net = ground_force(equation.dynamics, actuation.forces);
  for (std::size_t i = 0; i < contacts.feet().soles().size(); ++i) {
    const int sole = contacts.feet().soles()[i];
    const std::vector<int>& ankle = equation.figure->soles[at(sole)].ankle_dofs;
    if (std::ranges::find(ankle, dof) == ankle.end()) continue;
    return contacts.feet().soles().size() == 1 || ground_.share(i, net).force.y > kMostOfLoad * net.force.y ? sole : -1;
  }
  return -1;
}

// Takes something from the joint that is overloaded most: a foot in the air comes later, and the zero moment point of a
// foot that bears most of the weight comes nearer to its ankle; others are spared by all that moves. Answers whether
// there was anything to do.
bool Standing::relieve(const EquationOfMotion& equation, FootContacts& contacts, const Actuation& actuation) {
  const DynamicFigure& figure = *equation.figure;
  const Overload worst = greatest_share(figure, actuation.efforts);
  if (const int swinging = contacts.swinging(worst.dof); swinging >= 0) {
    contacts.ask_less(swinging, 0.8 / worst.share, actuation.acceleration);
    return true;
  }
  const bool carries =
      contacts.led_by_dof()[at(worst.dof)] != 0 || std::ranges::find(figure.watched, worst.dof) != figure.watched.end();
  if (carries && ++asked_ <= kAskedOfSwing && ask_less_of_swing(contacts, 0.8 / worst.share, actuation)) return true;
  if (const int sole = carried_by(equation, contacts, actuation, worst.dof); sole >= 0) {
    const Sole& foot = figure.soles[at(sole)];
    const Vec3 ankle_m = sole_place(foot, equation.dynamics) * foot.ankle_m;
    const Vec3 now = has_zmp_ ? zmp_m_ : balance(equation, actuation.forces).zmp_m;
    corners_m_ = area_.corners_m;
    zmp_m_ = nearest_inside(corners_m_, kEdge_m, ankle_m + (0.97 / worst.share) * (now - ankle_m), hull_);
    has_zmp_ = true;
    return true;
  }
  if (std::ranges::any_of(spared_, [&](const Spared& spared) { return spared.dof == worst.dof; })) return false;
  const std::vector<double>& limits =
      actuation.efforts[at(worst.dof)] > 0.0 ? figure.strength_high : figure.strength_low;
  spared_.push_back({worst.dof, 0.95 * limits[at(worst.dof)]});
  if (!carries) ease_[at(worst.dof)] = kYields;
  return true;
}

// Back towards holding still, as far as joints cannot give more.
void Standing::hold_back(EquationOfMotion& equation, FootContacts& contacts, Recorder& record, Actuation& actuation) {
  const DynamicFigure& figure = *equation.figure;
  std::ranges::fill(hold_.acceleration, 0.0);
  contacts.keep(hold_.acceleration);
  equation.find_forces(hold_.acceleration, hold_.forces);
  if (!rows_.empty()) ground_control_.meet(equation, ease_, rows_, contacts.support(), hold_);
  find_efforts(equation, hold_);
  take_back(hold_, affordable_share(figure, hold_.efforts, actuation.efforts), actuation);
  if (!exceeds_strength(figure, actuation.efforts)) return;
  record.overpowered();
  record.efforts(actuation.efforts);
  give_way(equation, contacts, actuation);
}

// If even holding still is too much for a joint, joints give what they have and the rest follows.
void Standing::give_way(EquationOfMotion& equation, FootContacts& contacts, Actuation& actuation) {
  clamp_to_strength(*equation.figure, actuation.efforts);
  equation.find_factors();
  for (std::size_t k = 0; k < equation.size(); ++k) actuation.acceleration[k] = actuation.efforts[k] - equation.bias[k];
  respond(equation.body(), equation.factors, contacts.support(), contacts.support().wanted, response_,
          actuation.acceleration);
  equation.find_forces(actuation.acceleration, actuation.forces);
}

bool Standing::could_stand(const EquationOfMotion& equation, const FootContacts& contacts) {
  find_support_area(*equation.figure, contacts.feet(), 0.0, equation.dynamics, area_);
  corners_m_ = area_.corners_m;
  const Vec3 capture_m = steering_.capture_m(frame_, equation);
  return length(capture_m - nearest_inside(corners_m_, 0.0, capture_m, hull_)) < kCatches_m;
}

}  // namespace contort
