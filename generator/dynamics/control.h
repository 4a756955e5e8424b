// Dynamic control (seed D3, D4; M. Oshita and A. Makinouchi, "A dynamic motion control technique for human-like
// articulated figures", Eurographics 2001): where a joint carries more than it would without loads, and where the zero
// moment point leaves the support, accelerations of a few freedoms are changed: arms, then the back, then the lower
// body. Both are least squares over the group's handles, with effort in units of the joints' own strength;
// docs/internals/dynamics.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "generator/dynamics/ground.h"
#include "generator/dynamics/support.h"

namespace contort {

inline constexpr std::size_t kMostHandles = 8;  // greatest number of handles of one group

// The values that control reads in one tick, and the accelerations and forces that control modifies.
struct ControlTick {
  const DynamicFigure& figure;
  DynamicsScratch& dynamics;     // after inverse_dynamics with acceleration 0
  std::span<const double> mass;  // mass_matrix
  std::span<const char> legs;    // by degree of freedom: true for legs that stand
  SupportRows& support;
  const SupportArea& area;
  const GroundShare& ground;
  double weight_N = 0.0;
  std::span<double> acceleration;  // accelerations of the actual figure
  std::span<double> forces;        // M a + h
};

class DynamicControl {
 public:
  void begin(const DynamicFigure& figure, double tick_s);

  // Changes tick.acceleration and tick.forces.
  void correct(const ControlTick& tick);

  // Resets control: feet have landed or left the ground in this tick.
  void rest();

  // The accelerations that it added in the last tick, by degree of freedom.
  std::span<const double> added() const { return added_; }

 private:
  // A handle's unit acceleration, and the necessary forces.
  struct Column {
    std::vector<double> acceleration;
    std::vector<double> forces;
  };
  struct Squares {  // the normal equations of a group
    std::array<double, kMostHandles * kMostHandles> matrix{};
    std::array<double, kMostHandles> right{};
    int rows = 0;
  };
  void find_nominal(const ControlTick& tick);
  bool find_overload(const ControlTick& tick);
  void prepare_columns(const ControlTick& tick, const ControlGroup& group);
  Squares relief_rows(const ControlTick& tick, const ControlGroup& group) const;
  Squares balance_rows(const ControlTick& tick, const ControlGroup& group) const;
  void step(const ControlTick& tick, const ControlGroup& group, Squares squares, double price, double lag,
            std::span<double> given);
  void add(const ControlTick& tick, const Column& column, double given);
  double strength(const DynamicFigure& figure, int dof) const;

  double relief_lag_ = 1.0;
  double balance_lag_ = 1.0;
  std::vector<double> relief_;  // by handle of all groups: the present additional accelerations
  std::vector<double> balance_;
  std::vector<double> added_;
  std::vector<double> overload_;
  std::vector<double> nominal_;   // forces without loads
  std::vector<double> bearable_;  // by watched degree of freedom, N m
  std::vector<Column> columns_;
  bool legs_ready_ = false;
  bool columns_ready_ = false;
};

}  // namespace contort
