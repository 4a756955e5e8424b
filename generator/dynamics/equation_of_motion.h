// The figure in motion: its state, and the terms of its equation of motion M(q) a + h(q, v) = forces (dynamics.h).
#pragma once

#include "generator/dynamics/dynamics.h"
#include "generator/dynamics/figure.h"
#include "generator/dynamics/tracker.h"

namespace contort {

// Rows by freedom: accelerations, the generalised forces M a + h that they take, and the joints' efforts (N m, N).
struct Actuation {
  std::vector<double> acceleration;
  std::vector<double> forces;
  std::vector<double> efforts;

  void assign(std::size_t dofs) {
    for (std::vector<double>* row : {&acceleration, &forces, &efforts}) row->assign(dofs, 0.0);
  }
};

// Accelerations on the way from those of `hold` to these, by a share in [0, 1].
void take_back(const Actuation& hold, double share, Actuation& actuation);

// Each term holds for the state in which it was found, and is found in this order. The state is anybody's to change.
struct EquationOfMotion {
  const DynamicFigure* figure = nullptr;
  FigureState state;
  DynamicsScratch dynamics;     // of the placed pose; after find_bias with the links' velocities
  std::vector<double> mass;     // M, as mass_matrix
  std::vector<double> factors;  // of M, as factorise
  std::vector<double> bias;     // h: the forces of no acceleration at all
  std::vector<double> still;    // zeros

  void begin(const DynamicFigure& of, const FigureState& start);
  const Multibody& body() const { return figure->body; }
  std::size_t size() const { return still.size(); }
  double weight_N() const { return kGravity_m_s2 * body().mass_kg(); }

  void place();
  void find_bias();
  void find_mass();
  void find_factors();
  void find_forces(std::span<const double> acceleration, std::span<double> forces) const;  // needs bias and mass
};

}  // namespace contort
