// Accelerations with which the ground's force is what the ground can give. Its six numbers are linear in them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "generator/dynamics/equation_of_motion.h"
#include "generator/dynamics/ground.h"
#include "generator/dynamics/support.h"

namespace contort {

// A condition on the root's entries of generalised forces (ground_force in ground.h), and on that of one more freedom:
// row . entries + forces[dof] = wanted.
struct GroundRow {
  std::array<double, kRootDofs> row{};
  int dof = -1;
  double wanted = 0.0;
  double softness = 0.0;  // 0: met exactly; 1: by half, where no other row asks for the same
};

// The one with which the ground presses with this force.
void add_pressure_row(double force_N, std::vector<GroundRow>& rows);

// The two with which the ground's force acts at this point, from the world's origin: no moment about level axes there.
void add_zmp_rows(const Placement& root, const Vec3& point_m, std::vector<GroundRow>& rows);

// The six with which the ground gives nothing.
void add_flight_rows(std::vector<GroundRow>& rows);

// The one with which a joint has this effort. `zeros`, one a freedom, are memory and zeros again afterwards.
void add_effort_row(const GroundShare& share, const DynamicsScratch& dynamics, int dof, double effort,
                    std::span<double> zeros, std::vector<GroundRow>& rows);

class GroundControl {
 public:
  // The nearest accelerations that meet these rows and go on leading the soles; changes an actuation's accelerations
  // and forces. Needs find_mass, find_bias and the projection of the support.
  void meet(const EquationOfMotion& equation, std::span<const double> ease, std::span<const GroundRow> rows,
            SupportRows& support, Actuation& actuation);

 private:
  std::vector<double> entries_;  // by row and freedom: what an acceleration adds to it
  std::vector<double> columns_;  // by row and freedom: accelerations that keep the soles
  std::vector<double> matrix_;
  std::vector<double> shares_;
};

}  // namespace contort
