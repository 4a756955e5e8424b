#include "generator/dynamics/impact.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"

namespace contort {

void respond(const Multibody& body, std::span<const double> factors, const SupportRows& support,
             std::span<const double> wanted, ResponseScratch& scratch, std::span<double> x) {
  const auto n = static_cast<std::size_t>(body.dof_count()), m = static_cast<std::size_t>(support.count);
  solve(body, factors, x);
  scratch.push.assign(m, 0.0);
  if (m == 0) return;
  scratch.rows.assign(m * n, 0.0);
  scratch.matrix.resize(m * m);
  for (const int dof : support.dofs)
    for (std::size_t i = 0; i < m; ++i) scratch.rows[i * n + static_cast<std::size_t>(dof)] = support.column(dof)[i];
  scratch.columns = scratch.rows;
  const auto row = [&](std::size_t i) { return std::span<const double>(scratch.rows).subspan(i * n, n); };
  const auto column = [&](std::size_t i) { return std::span(scratch.columns).subspan(i * n, n); };
  for (std::size_t i = 0; i < m; ++i) {
    solve(body, factors, column(i));
    for (std::size_t j = 0; j <= i; ++j) scratch.matrix[i * m + j] = dot(row(j), column(i));
    scratch.push[i] = wanted[i] - dot(row(i), x);
  }
  solve_symmetric(scratch.matrix, support.count, scratch.push);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < n; ++k) x[k] += column(i)[k] * scratch.push[i];
}

void brace(std::span<const double> velocity, std::span<const double> stiff, std::span<const double> fastest,
           std::span<double> change) {
  double share = 1.0;
  for (std::size_t k = kRootDofs; k < change.size(); ++k) {
    const double most = std::max(fastest[k], std::fabs(velocity[k]));
    const double room = change[k] > 0.0 ? most - velocity[k] : most + velocity[k];
    if (std::fabs(change[k]) > room) share = std::min(share, room / std::fabs(change[k]));
  }
  for (std::size_t k = 0; k < change.size(); ++k) change[k] = stiff[k] + share * (change[k] - stiff[k]);
}

void add_impulse(const Multibody& body, const DynamicsScratch& dynamics, const Impact& impact,
                 std::span<double> impulse) {
  const Placement& link = dynamics.world[static_cast<std::size_t>(impact.link)];
  const Vec3 arm = link.origin_m + link.rotation * impact.point_m - dynamics.world[0].origin_m;
  const SpatialForce force{glm::cross(arm, impact.impulse_N_s), impact.impulse_N_s};
  const Link& last = body.links()[static_cast<std::size_t>(impact.link)];
  for (int k = last.dof + last.dof_count - 1; k >= 0; k = body.parent_dof()[static_cast<std::size_t>(k)])
    impulse[static_cast<std::size_t>(k)] += dot(dynamics.freedoms[static_cast<std::size_t>(k)], force);
}

}  // namespace contort
