#include "generator/dynamics/equation_of_motion.h"

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

void take_back(const Actuation& hold, double share, Actuation& actuation) {
  for (const auto row : {&Actuation::acceleration, &Actuation::forces, &Actuation::efforts})
    for (std::size_t k = 0; k < (hold.*row).size(); ++k)
      (actuation.*row)[k] = (hold.*row)[k] + share * ((actuation.*row)[k] - (hold.*row)[k]);
}

void EquationOfMotion::begin(const DynamicFigure& of, const FigureState& start) {
  figure = &of;
  state = start;
  const std::size_t n = at(of.body.dof_count());
  still.assign(n, 0.0);
  bias.assign(n, 0.0);
  mass.assign(n * n, 0.0);
  factors.assign(n * n, 0.0);
}

void EquationOfMotion::place() { contort::place(body(), state.root, state.coords, dynamics); }

void EquationOfMotion::find_bias() { inverse_dynamics(body(), state.velocity, still, kGravity_m_s2, dynamics, bias); }

void EquationOfMotion::find_mass() { mass_matrix(body(), dynamics, mass); }

void EquationOfMotion::find_factors() {
  factors = mass;
  factorise(body(), factors);
}

void EquationOfMotion::find_forces(std::span<const double> acceleration, std::span<double> forces) const {
  multiply(mass, acceleration, forces);
  add_scaled(1.0, bias, forces);
}

}  // namespace contort
