// The figure in motion: its state, and the terms of its equation of motion M(q) a + h(q, v) = forces (dynamics.h).
#pragma once

#include "generator/dynamics/dynamics.h"
#include "generator/dynamics/figure.h"
#include "generator/dynamics/tracker.h"

namespace contort {

// Rows by degree of freedom: accelerations, the generalised forces M a + h for them, and the joints' efforts (N m, N).
struct Actuation {
  std::vector<double> acceleration;
  std::vector<double> forces;
  std::vector<double> efforts;

  void assign(std::size_t dofs) {
    for (std::vector<double>* row : {&acceleration, &forces, &efforts}) row->assign(dofs, 0.0);
  }
};

// Moves accelerations, forces and efforts from those of `hold` towards these, by a fraction in [0, 1]. Forces depend
// linearly on accelerations, and soles that can give both can give what lies between.
void take_back(const Actuation& hold, double share, Actuation& actuation);

// Each term belongs to the state for which it was computed, and the terms are computed in this order. Callers may
// change the state.
struct EquationOfMotion {
  const DynamicFigure* figure = nullptr;
  FigureState state;
  DynamicsScratch dynamics;     // of the placed pose; after find_bias with the links' velocities
  std::vector<double> mass;     // factors of M, by factorise
  std::vector<double> factors;  // h: the forces without any acceleration
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
