#include "generator/dynamics/impact_response.h"

#include <algorithm>

#include "generator/dynamics/linear.h"
#include "generator/dynamics/loose.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kImpact_s = 0.05;  // duration of an impact: the weight presses on soles meanwhile

}  // namespace

// Soles keep the velocities that they have: a sole that rolls goes on rolling.
void ImpactResponse::add_soles(const EquationOfMotion& equation, const FootContacts& contacts,
                               const Environment& environment) {
  const DynamicFigure& figure = *equation.figure;
  std::size_t count = 0;
  for (const int s : contacts.feet().soles()) {
    points_m_.clear();
    add_bearing_points(figure.soles[at(s)], contacts.feet().bearing(s), 0.0, points_m_);
    count += points_m_.size();
  }
  for (const int s : contacts.feet().soles()) {
    const Sole& sole = figure.soles[at(s)];
    const Placement& link = equation.dynamics.world[at(sole.link)];
    points_m_.clear();
    add_bearing_points(sole, contacts.feet().bearing(s), 0.0, points_m_);
    for (const Vec3& point : points_m_) {
      const Vec3 place = link.origin_m + link.rotation * point;
      solver_.add_touch({sole.link, place - equation.dynamics.world[0].origin_m,
                         environment.nearest_ground(place).normal, 0.0,
                         equation.weight_N() * kImpact_s / static_cast<double>(count), true});
    }
  }
}

// The change of the velocities that the impulse makes, and the ground with it.
void ImpactResponse::answer(const EquationOfMotion& equation, const FootContacts& contacts,
                            const Environment& environment, bool is_stiff, std::vector<double>& change) {
  change.assign(equation.size(), 0.0);
  if (is_stiff) {
    std::vector<double>& taken = velocity_;
    taken.assign(impulse_.begin(), impulse_.end());
    for (double& impulse : taken) impulse = -impulse;
    fall_freely(equation.body(), equation.mass, change, taken);
  } else {
    change = impulse_;
    solve(equation.body(), equation.factors, change);
  }
  solver_.begin(equation, is_stiff);
  add_soles(equation, contacts, environment);
  solver_.solve(change);
}

void ImpactResponse::find_sole_speed(const EquationOfMotion& equation, const FootContacts& contacts) {
  sole_speed_m_s_ = 0.0;
  for (const int s : contacts.feet().soles()) {
    const Sole& sole = equation.figure->soles[at(s)];
    const Placement& link = equation.dynamics.world[at(sole.link)];
    SpatialMotion moved;
    const Link& last = equation.body().links()[at(sole.link)];
    for (int k = last.dof + last.dof_count - 1; k >= 0; k = equation.body().parent_dof()[at(k)])
      moved += change_[at(k)] * equation.dynamics.freedoms[at(k)];
    for (const Vec3& corner : sole.corners_m) {
      const Vec3 from_root = link.origin_m + link.rotation * corner - equation.dynamics.world[0].origin_m;
      sole_speed_m_s_ = std::max(sole_speed_m_s_, length(point_velocity(moved, from_root)));
    }
  }
}

void ImpactResponse::strike(EquationOfMotion& equation, const FootContacts& contacts, const Environment& environment,
                            const Impact& impact) {
  impulse_.assign(equation.size(), 0.0);
  add_impulse(equation.body(), equation.dynamics, impact, impulse_);
  answer(equation, contacts, environment, true, stiff_);
  answer(equation, contacts, environment, false, change_);
  brace(equation.state.velocity, stiff_, equation.figure->fastest, change_);
  find_sole_speed(equation, contacts);
  add_scaled(1.0, change_, equation.state.velocity);
}

}  // namespace contort
