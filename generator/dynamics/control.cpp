#include "generator/dynamics/control.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"
#include "model/core/detmath.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kComfort = 0.3;         // share of its strength that a joint may always use
constexpr double kUnnoticed = 0.01;      // share of its strength by which a load must change its effort
constexpr double kMargin_m = 0.01;       // that the zero moment point keeps from the edge
constexpr double kBalanceArm_m = 0.05;   // scale of moments about edges: the weight with this arm
constexpr double kReliefLag_s = 0.08;    // relief comes softly, or a limit cycle would shake the arms
constexpr double kBalanceLag_s = 0.015;  // balance comes at once: five times slower it comes too late
constexpr double kReliefPrice = 0.02;
constexpr double kBalancePrice = 1e-3;
constexpr double kLeastPrice = 1e-6;
constexpr double kRootPrice = 1e-3;

double follow(double tick_s, double lag_s) { return 1.0 - det::exp(-tick_s / lag_s); }

// A unit acceleration along a handle; a ball's axis is its parent's, its rates are along the axes of the moved body.
void put_unit(const Handle& handle, const DynamicFigure& figure, const DynamicsScratch& dynamics,
              std::span<double> out) {
  std::ranges::fill(out, 0.0);
  if (!handle.is_ball) {
    out[at(handle.dof)] = 1.0;
    return;
  }
  const int parent = figure.body.links()[at(handle.link)].parent;
  const Vec3 world = dynamics.world[at(parent)].rotation * handle.axis;
  for (int k = 0; k < 3; ++k) out[at(handle.dof + k)] = glm::dot(dynamics.world[at(handle.link)].rotation[k], world);
}

// The forces that would act without the loads, at the same accelerations.
void without_loads(const ControlTick& tick, std::span<double> forces) {
  std::copy(tick.forces.begin(), tick.forces.end(), forces.begin());
  const DynamicsScratch& d = tick.dynamics;
  for (const Load& load : tick.figure.loads) {
    const Link& link = tick.figure.body.links()[at(load.link)];
    const int last = link.dof + link.dof_count - 1;
    SpatialMotion acceleration = d.acceleration[at(load.link)];
    for (int k = last; k >= 0; k = tick.figure.body.parent_dof()[at(k)])
      acceleration += tick.acceleration[at(k)] * d.freedoms[at(k)];
    const SpatialInertia inertia = placed_inertia(load.mass_kg, load.center_of_mass_m, load.inertia_kg_m2,
                                                  d.world[at(load.link)], d.world[0].origin_m);
    const SpatialForce force = force_of(inertia, d.velocity[at(load.link)], acceleration);
    for (int k = last; k >= 0; k = tick.figure.body.parent_dof()[at(k)]) forces[at(k)] -= dot(d.freedoms[at(k)], force);
  }
}

// Makes values smaller until none is larger than `greatest`: together, not one by one, so that what is symmetric stays
// so.
void bound(double greatest, std::span<double> values) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::fabs(v));
  if (largest > greatest)
    for (double& v : values) v *= greatest / largest;
}

}  // namespace

void DynamicControl::begin(const DynamicFigure& figure, double tick_s) {
  relief_lag_ = follow(tick_s, kReliefLag_s);
  balance_lag_ = follow(tick_s, kBalanceLag_s);
  std::size_t handles = 0;
  for (const ControlGroup& group : figure.groups) handles += group.handles.size();
  relief_.assign(handles, 0.0);
  balance_.assign(handles, 0.0);
  const auto n = at(figure.body.dof_count());
  added_.assign(n, 0.0);
  nominal_.assign(n, 0.0);
  overload_.assign(figure.watched.size(), 0.0);
  bearable_.assign(figure.watched.size(), 0.0);
  columns_.assign(kMostHandles, {std::vector<double>(n), std::vector<double>(n)});
}

void DynamicControl::rest() {
  std::ranges::fill(relief_, 0.0);
  std::ranges::fill(balance_, 0.0);
  std::ranges::fill(added_, 0.0);
}

double DynamicControl::strength(const DynamicFigure& figure, int dof) const {
  return std::max({-figure.strength_low[at(dof)], figure.strength_high[at(dof)], 1e-3});
}

// The effort that a joint may bear: what the figure would need without its loads, and what is comfortable anyway.
void DynamicControl::find_nominal(const ControlTick& tick) {
  if (tick.figure.loads.empty()) return;
  without_loads(tick, nominal_);
  const SpatialForce multipliers = tick.ground.multipliers(tick.dynamics, nominal_);
  for (std::size_t i = 0; i < bearable_.size(); ++i) {
    const int dof = tick.figure.watched[i];
    const double nominal = tick.ground.effort(tick.dynamics, nominal_, multipliers, dof);
    const double most = strength(tick.figure, dof);
    bearable_[i] = std::max(kComfort * most, std::fabs(nominal) + kUnnoticed * most);
  }
}

bool DynamicControl::find_overload(const ControlTick& tick) {
  if (tick.figure.loads.empty()) return false;
  bool any = false;
  const SpatialForce multipliers = tick.ground.multipliers(tick.dynamics, tick.forces);
  for (std::size_t i = 0; i < overload_.size(); ++i) {
    const double effort = tick.ground.effort(tick.dynamics, tick.forces, multipliers, tick.figure.watched[i]);
    overload_[i] = std::copysign(std::max(0.0, std::fabs(effort) - bearable_[i]), effort);
    any = any || overload_[i] != 0.0;
  }
  return any;
}

void DynamicControl::prepare_columns(const ControlTick& tick, const ControlGroup& group) {
  if (columns_ready_) return;
  columns_ready_ = true;
  for (std::size_t h = 0; h < group.handles.size(); ++h) {
    put_unit(group.handles[h], tick.figure, tick.dynamics, columns_[h].acceleration);
    if (group.moves_feet && tick.support.count > 0) {
      if (!legs_ready_) prepare_keep_feet(tick.legs, tick.support);
      legs_ready_ = true;
      keep_feet(tick.legs, tick.support, columns_[h].acceleration);
    }
    multiply(tick.mass, columns_[h].acceleration, columns_[h].forces);
  }
}

DynamicControl::Squares DynamicControl::relief_rows(const ControlTick& tick, const ControlGroup& group) const {
  Squares squares;
  std::array<double, kMostHandles> row;
  std::array<SpatialForce, kMostHandles> multipliers;
  const std::size_t n = group.handles.size();
  for (std::size_t h = 0; h < n; ++h) multipliers[h] = tick.ground.multipliers(tick.dynamics, columns_[h].forces);
  for (std::size_t i = 0; i < overload_.size(); ++i) {
    const int dof = tick.figure.watched[i];
    const double effort = overload_[i];
    if (effort == 0.0) continue;
    const double scale = 1.0 / strength(tick.figure, dof);
    for (std::size_t h = 0; h < n; ++h)
      row[h] = scale * tick.ground.effort(tick.dynamics, columns_[h].forces, multipliers[h], dof);
    for (std::size_t a = 0; a < n; ++a) {
      squares.right[a] -= row[a] * scale * effort;
      for (std::size_t b = 0; b <= a; ++b) squares.matrix[a * n + b] += row[a] * row[b];
    }
    ++squares.rows;
  }
  return squares;
}

// Moments about the edges that are less than the margin asks: linear in the accelerations.
DynamicControl::Squares DynamicControl::balance_rows(const ControlTick& tick, const ControlGroup& group) const {
  Squares squares;
  std::array<double, kMostHandles> row;
  const std::size_t n = group.handles.size();
  const double scale = 1.0 / (tick.weight_N * kBalanceArm_m);
  const auto beyond = [&](const SupportEdge& edge, std::span<const double> forces) {
    return scale * (dot(edge.row, forces.first(kRootDofs)) - kMargin_m * forces[1]);
  };
  for (const SupportEdge& edge : tick.area.edges) {
    const double missing = beyond(edge, tick.forces);
    if (missing >= 0.0) continue;
    for (std::size_t h = 0; h < n; ++h) row[h] = beyond(edge, columns_[h].forces);
    for (std::size_t a = 0; a < n; ++a) {
      squares.right[a] -= row[a] * missing;
      for (std::size_t b = 0; b <= a; ++b) squares.matrix[a * n + b] += row[a] * row[b];
    }
    ++squares.rows;
  }
  return squares;
}

void DynamicControl::step(const ControlTick& tick, const ControlGroup& group, Squares squares, double price, double lag,
                          std::span<double> given) {
  const std::size_t n = group.handles.size();
  const std::span<double> best = std::span(squares.right).first(n);
  if (squares.rows > 0) {
    for (std::size_t h = 0; h < n; ++h) {
      double effort = group.handles[h].dof < kRootDofs ? kRootPrice : 0.0;
      for (const Handle& own : group.handles) {
        if (own.dof < kRootDofs) continue;
        const double share = columns_[h].forces[at(own.dof)] / strength(tick.figure, own.dof);
        effort += share * share;
      }
      squares.matrix[h * n + h] += price * std::max(kLeastPrice, effort);
    }
    solve_symmetric(std::span(squares.matrix).first(n * n), static_cast<int>(n), best);
    bound(group.greatest, best);
  }
  for (std::size_t h = 0; h < n; ++h) {
    given[h] += lag * (best[h] - given[h]);
    if (squares.rows == 0 && std::fabs(given[h]) < 1e-6) given[h] = 0.0;
    if (given[h] == 0.0) continue;
    add(tick, columns_[h], given[h]);
  }
}

void DynamicControl::add(const ControlTick& tick, const Column& column, double given) {
  add_scaled(given, column.acceleration, added_);
  add_scaled(given, column.acceleration, tick.acceleration);
  add_scaled(given, column.forces, tick.forces);
}

void DynamicControl::correct(const ControlTick& tick) {
  std::ranges::fill(added_, 0.0);
  legs_ready_ = false;
  find_nominal(tick);
  const auto is_zero = [](double v) { return v == 0.0; };
  std::size_t first = 0;
  for (const ControlGroup& group : tick.figure.groups) {
    const std::span<double> relief = std::span(relief_).subspan(first, group.handles.size());
    const std::span<double> balance = std::span(balance_).subspan(first, group.handles.size());
    first += group.handles.size();
    columns_ready_ = false;
    if (find_overload(tick) || !std::ranges::all_of(relief, is_zero)) {
      prepare_columns(tick, group);
      step(tick, group, relief_rows(tick, group), kReliefPrice, relief_lag_, relief);
    }
    const Balance now = balance_of(tick.area, tick.dynamics, tick.forces, tick.weight_N);
    if (now.margin_m < kMargin_m || !std::ranges::all_of(balance, is_zero)) {
      prepare_columns(tick, group);
      step(tick, group, balance_rows(tick, group), kBalancePrice, balance_lag_, balance);
    }
  }
}

}  // namespace contort
