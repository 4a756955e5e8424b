// Accelerations for which the ground can supply the force. The six numbers of the ground's force are linear in them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "generator/dynamics/equation_of_motion.h"
#include "generator/dynamics/ground.h"
#include "generator/dynamics/support.h"

namespace contort {

// A condition on the root's entries of generalised forces (ground_force in ground.h), and on that of one more degree of
// freedom: row . entries + forces[dof] = wanted.
struct GroundRow {
  std::array<double, kRootDofs> row{};
  int dof = -1;
  double wanted = 0.0;
  double softness = 0.0;  // 0: met exactly; 1: met by half, unless another row has the same condition
};

// Adds the row for a given pressing force of the ground.
void add_pressure_row(double force_N, std::vector<GroundRow>& rows);

// Adds the two rows for a ground force at this point, from the world's origin: no moment about level axes there.
void add_zmp_rows(const Placement& root, const Vec3& point_m, std::vector<GroundRow>& rows);

// Adds the six rows for no ground force at all.
void add_flight_rows(std::vector<GroundRow>& rows);

// Adds the row for a given effort of a joint. `zeros`, one for each degree of freedom, are scratch and zero again
// afterwards.
void add_effort_row(const GroundShare& share, const DynamicsScratch& dynamics, int dof, double effort,
                    std::span<double> zeros, std::vector<GroundRow>& rows);

class GroundControl {
 public:
  // Finds the nearest accelerations that meet these rows and keep guiding the soles; changes an actuation's
  // accelerations and forces. Needs find_mass, find_bias and the projection of the support.
  void meet(const EquationOfMotion& equation, std::span<const double> ease, std::span<const GroundRow> rows,
            SupportRows& support, Actuation& actuation);

 private:
  std::vector<double> entries_;  // by row and degree of freedom: the effect of a unit acceleration
  std::vector<double> columns_;  // by row and degree of freedom: accelerations that keep the soles
  std::vector<double> matrix_;
  std::vector<double> shares_;
};

}  // namespace contort
