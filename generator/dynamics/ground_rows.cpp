#include "generator/dynamics/ground_rows.h"

#include <algorithm>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kSpareSoftly = 0.3;  // a joint that is spared at any price throws the figure

}  // namespace

void add_zmp_rows(const Placement& root, const Vec3& point_m, std::vector<GroundRow>& rows) {
  const Vec3 arm = root.origin_m - point_m;
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 0, 1)}) {
    GroundRow out;
    const Vec3 force = glm::cross(axis, arm);  // axis . (arm x f)
    for (int k = 0; k < 3; ++k) {
      out.row[at(k)] = force[k];
      out.row[at(3 + k)] = glm::dot(axis, root.rotation[k].narrow());
    }
    rows.push_back(out);
  }
}

void add_pressure_row(double force_N, std::vector<GroundRow>& rows) {
  GroundRow out;
  out.row[1] = 1.0, out.wanted = force_N;
  rows.push_back(out);
}

void add_flight_rows(std::vector<GroundRow>& rows) {
  for (std::size_t k = 0; k < kRootDofs; ++k) {
    GroundRow out;
    out.row[k] = 1.0;
    rows.push_back(out);
  }
}

void add_effort_row(const GroundShare& share, const DynamicsScratch& dynamics, int dof, double effort,
                    std::span<double> zeros, std::vector<GroundRow>& rows) {
  GroundRow out;
  for (std::size_t k = 0; k < kRootDofs; ++k) {
    zeros[k] = 1.0;
    out.row[k] = share.effort(dynamics, zeros, dof);
    zeros[k] = 0.0;
  }
  out.dof = dof, out.wanted = effort, out.softness = kSpareSoftly;
  rows.push_back(out);
}

void GroundControl::meet(const EquationOfMotion& equation, std::span<const double> ease,
                         std::span<const GroundRow> rows, SupportRows& support, Actuation& actuation) {
  const std::size_t n = equation.size(), m = rows.size();
  entries_.assign(m * n, 0.0), columns_.resize(m * n), matrix_.assign(m * m, 0.0), shares_.resize(m);
  const std::span<const double> mass(equation.mass);
  const auto entry = [&](std::size_t k) { return std::span(entries_).subspan(k * n, n); };
  const auto column = [&](std::size_t k) { return std::span(columns_).subspan(k * n, n); };
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t i = 0; i < kRootDofs; ++i)
      if (rows[k].row[i] != 0.0) add_scaled(rows[k].row[i], mass.subspan(i * n, n), entry(k));
    if (rows[k].dof >= 0) add_scaled(1.0, mass.subspan(at(rows[k].dof) * n, n), entry(k));
    for (std::size_t j = 0; j < n; ++j) column(k)[j] = ease[j] * entry(k)[j];
    keep_still(ease, support, column(k));
    shares_[k] = rows[k].wanted - dot(rows[k].row, std::span(actuation.forces).first(kRootDofs)) -
                 (rows[k].dof >= 0 ? actuation.forces[at(rows[k].dof)] : 0.0);
    for (std::size_t l = 0; l <= k; ++l) matrix_[k * m + l] = dot(entry(k), column(l));
  }
  for (std::size_t k = 0; k < m; ++k) matrix_[k * m + k] *= 1.0 + rows[k].softness;
  solve_symmetric(matrix_, static_cast<int>(m), shares_);
  for (std::size_t k = 0; k < m; ++k) add_scaled(shares_[k], column(k), actuation.acceleration);
  equation.find_forces(actuation.acceleration, actuation.forces);
}

}  // namespace contort
