#include "generator/dynamics/support.h"

#include <algorithm>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

// Columns of one foot: rows [6 f, 6 f + 6).
void add_foot(const Multibody& body, const LedSole& foot, const Vec3& sole_m, int first_row,
              const DynamicsScratch& dynamics, SupportRows& support) {
  const Vec3 from_root_m = sole_m - dynamics.world[0].origin_m;
  const Link& last = body.links()[at(foot.link)];
  for (int j = last.dof + last.dof_count - 1; j >= 0; j = body.parent_dof()[at(j)]) {
    const SpatialMotion& freedom = dynamics.freedoms[at(j)];
    const Vec3 moved = freedom.linear + glm::cross(freedom.angular, from_root_m);
    double* column = &support.columns[at(j * support.count + first_row)];
    for (int k = 0; k < 3; ++k) column[k] = moved[k], column[3 + k] = freedom.angular[k];
  }
}

// Wanted accelerations: those of the plan without those that velocities cause (`carried`), and the springs. The plan's
// rates are those of the middle of the last tick, `late_s` ago. The present pose moves with rates that are as old.
void want_to_follow(const LedSole& foot, const Vec3& sole_m, double frequency, const SpatialMotion& carried,
                    double late_s, const DynamicsScratch& dynamics, double* wanted) {
  const Placement& link = dynamics.world[at(foot.link)];
  const SpatialMotion& v = dynamics.velocity[at(foot.link)];
  const Quat now = glm::quat_cast(Mat3(link.rotation)) * foot.link_from_sole.q;
  const Rigid& wanted_pose = foot.wanted.world_from_sole;
  const Vec3 off[2] = {sole_m - wanted_pose.p_m, to_rotation_vector(now * glm::conjugate(wanted_pose.q))};
  const Vec3 ahead[2] = {foot.linear_m_s2, foot.angular_rad_s2};
  const Vec3 bias[2] = {carried.linear, carried.angular};
  const Vec3 speed[2] = {
      point_velocity(v, sole_m - dynamics.world[0].origin_m) - late_s * bias[0] - foot.wanted.linear,
      v.angular - late_s * bias[1] - foot.wanted.angular};
  for (int r = 0; r < 6; ++r) {
    const int part = r / 3, k = r % 3;
    wanted[r] =
        ahead[part][k] - bias[part][k] - 2.0 * frequency * speed[part][k] - frequency * frequency * off[part][k];
  }
}

bool moves_a_foot(const SupportRows& support, int dof) {
  return std::ranges::any_of(support.column(dof), [](double v) { return v != 0.0; });
}

// x + E J^T (J E J^T)^-1 (wanted - J x), E: ease; wanted = 0 where none is given
void project(std::span<const double> ease, std::span<const double> wanted, SupportRows& support, std::span<double> x) {
  const auto m = at(support.count);
  if (m == 0) return;
  support.scratch.resize(std::max(support.scratch.size(), m));
  const std::span<double> force = std::span(support.scratch).first(m);
  soles_moved_by(support, x, force);
  for (std::size_t i = 0; i < m; ++i) force[i] = (wanted.empty() ? 0.0 : wanted[i]) - force[i];
  solve_factorised(support.project_factors, support.count, force);
  for (const int dof : support.dofs) x[at(dof)] += ease[at(dof)] * dot(support.column(dof), force);
}

}  // namespace

void support_rows(const Multibody& body, std::span<const LedSole> feet, std::span<const double> velocity,
                  std::span<const int> still_dofs, double frequency_rad_s, double late_s,
                  const DynamicsScratch& dynamics, SupportRows& support) {
  support.count = static_cast<int>(6 * feet.size() + still_dofs.size());
  support.columns.assign(velocity.size() * at(support.count), 0.0);
  support.wanted.assign(at(support.count), 0.0);
  for (std::size_t k = 0; k < still_dofs.size(); ++k)
    support.columns[at(still_dofs[k] * support.count) + 6 * feet.size() + k] = 1.0;
  for (std::size_t f = 0; f < feet.size(); ++f) {
    const Placement& link = dynamics.world[at(feet[f].link)];
    const Vec3 sole_m = link.origin_m + link.rotation * feet[f].link_from_sole.p_m;
    add_foot(body, feet[f], sole_m, static_cast<int>(6 * f), dynamics, support);
    const SpatialMotion carried = carried_acceleration(body, dynamics, feet[f].link, sole_m, velocity);
    want_to_follow(feet[f], sole_m, frequency_rad_s, carried, late_s, dynamics, &support.wanted[6 * f]);
  }
  support.dofs.clear();
  for (int dof = 0; dof < body.dof_count(); ++dof)
    if (moves_a_foot(support, dof)) support.dofs.push_back(dof);
}

void soles_moved_by(const SupportRows& support, std::span<const double> x, std::span<double> out) {
  std::ranges::fill(out, 0.0);
  for (const int dof : support.dofs) add_scaled(x[at(dof)], support.column(dof), out);
}

void prepare_projection(std::span<const double> ease, SupportRows& support) {
  support.project_factors.assign(at(support.count) * at(support.count), 0.0);
  for (const int dof : support.dofs) add_square(support.column(dof), ease[at(dof)], support.project_factors);
  if (support.count > 0) factorise_symmetric(support.project_factors, support.count);
}

void keep_still(std::span<const double> ease, SupportRows& support, std::span<double> change) {
  project(ease, {}, support, change);
}

void project_on_support(std::span<const double> ease, SupportRows& support, std::span<double> acceleration) {
  project(ease, support.wanted, support, acceleration);
}

// (J_l J_l^T + damping): a straight knee would have the legs answer without bound
void prepare_keep_feet(std::span<const char> legs, SupportRows& support) {
  const auto m = at(support.count);
  constexpr double kDamping = 1e-6;
  support.factors.assign(m * m, 0.0);
  for (std::size_t i = 0; i < m; ++i) support.factors[i * m + i] = kDamping;
  for (const int dof : support.dofs)
    if (legs[at(dof)] != 0) add_square(support.column(dof), 1.0, support.factors);
  factorise_symmetric(support.factors, support.count);
}

void keep_feet(std::span<const char> legs, SupportRows& support, std::span<double> change) {
  support.scratch.resize(std::max(support.scratch.size(), at(support.count)));
  const std::span<double> force = std::span(support.scratch).first(at(support.count));
  soles_moved_by(support, change, force);
  for (double& f : force) f = -f;
  solve_factorised(support.factors, support.count, force);
  for (const int dof : support.dofs)
    if (legs[at(dof)] != 0) change[at(dof)] += dot(support.column(dof), force);
}

}  // namespace contort
