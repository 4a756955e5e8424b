#include "generator/dynamics/support.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"

namespace contort {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

Quat rotation_of(const Mat3& m) { return glm::quat_cast(m); }

}  // namespace

void support_rows(const Multibody& body, std::span<const StandingFoot> feet, std::span<const double> velocity,
                  double frequency_rad_s, double gravity_m_s2, const DynamicsScratch& dynamics, SupportRows& support) {
  const auto n = at(body.dof_count());
  support.count = 6 * static_cast<int>(feet.size());
  support.rows.resize(at(support.count) * n);
  support.wanted.resize(at(support.count));
  for (std::size_t f = 0; f < feet.size(); ++f) {
    const StandingFoot& foot = feet[f];
    const Placement& link = dynamics.world[at(foot.link)];
    const Vec3 sole = link.origin_m + link.rotation * foot.link_from_sole.p_m;
    const std::span<double> rows = std::span(support.rows).subspan(6 * f * n, 6 * n);
    point_jacobian(body, dynamics, foot.link, sole, rows.first(3 * n));
    angular_jacobian(body, dynamics, foot.link, rows.last(3 * n));
    const Quat now = rotation_of(link.rotation) * foot.link_from_sole.q;
    const Vec3 off[2] = {sole - foot.world_from_sole.p_m,
                         to_rotation_vector(now * glm::conjugate(foot.world_from_sole.q))};
    // Accelerations that the present velocities cause. Gravity is in them as one of the world.
    const Vec3 up(0.0, gravity_m_s2, 0.0);
    const Vec3 bias[2] = {point_acceleration(dynamics, foot.link, sole) - up,
                          dynamics.acceleration[at(foot.link)].angular};
    for (std::size_t r = 0; r < 6; ++r) {
      const int k = static_cast<int>(r % 3);
      const double speed = dot(rows.subspan(r * n, n), velocity);
      support.wanted[6 * f + r] =
          -bias[r / 3][k] - 2.0 * frequency_rad_s * speed - frequency_rad_s * frequency_rad_s * off[r / 3][k];
    }
  }
}

namespace {

// a + W^-1 J^T (J W^-1 J^T)^-1 (b - J a), b = 0 where none is wanted
void project(const Multibody& body, double root_weight, std::span<const double> wanted, SupportRows& support,
             std::span<double> acceleration) {
  const auto n = at(body.dof_count()), m = at(support.count);
  if (m == 0) return;
  support.scratch.resize(m * m + m);
  const std::span<double> matrix = std::span(support.scratch).first(m * m), force = std::span(support.scratch).last(m);
  const auto row = [&](std::size_t r) { return std::span<const double>(support.rows).subspan(r * n, n); };
  const double root_share = 1.0 / root_weight;
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j <= i; ++j)
      matrix[i * m + j] = root_share * dot(row(i).first(kRootDofs), row(j).first(kRootDofs)) +
                          dot(row(i).subspan(kRootDofs), row(j).subspan(kRootDofs));
    force[i] = (wanted.empty() ? 0.0 : wanted[i]) - dot(row(i), acceleration);
  }
  solve_symmetric(matrix, support.count, force);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < n; ++k) acceleration[k] += (k < kRootDofs ? root_share : 1.0) * row(i)[k] * force[i];
}

}  // namespace

void project_on_support(const Multibody& body, double root_weight, SupportRows& support,
                        std::span<double> acceleration) {
  project(body, root_weight, support.wanted, support, acceleration);
}

void stop_feet(const Multibody& body, double root_weight, SupportRows& support, std::span<double> velocity) {
  project(body, root_weight, {}, support, velocity);
}

// (J_l J_l^T + damping): a straight knee would have the legs answer without bound
void prepare_keep_feet(const Multibody& body, std::span<const char> legs, SupportRows& support) {
  const auto n = at(body.dof_count()), m = at(support.count);
  constexpr double kDamping = 1e-6;
  support.factors.assign(m * m, 0.0);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = i == j ? kDamping : 0.0;
      for (std::size_t k = kRootDofs; k < n; ++k)
        if (legs[k] != 0) sum += support.rows[i * n + k] * support.rows[j * n + k];
      support.factors[i * m + j] = sum;
    }
  factorise_symmetric(support.factors, support.count);
}

void keep_feet(const Multibody& body, std::span<const char> legs, SupportRows& support, std::span<double> change) {
  const auto n = at(body.dof_count()), m = at(support.count);
  support.scratch.resize(std::max(support.scratch.size(), m));
  const std::span<double> force = std::span(support.scratch).first(m);
  for (std::size_t i = 0; i < m; ++i) force[i] = -dot(std::span(support.rows).subspan(i * n, n), change);
  solve_factorised(support.factors, support.count, force);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = kRootDofs; k < n; ++k)
      if (legs[k] != 0) change[k] += support.rows[i * n + k] * force[i];
}

}  // namespace contort
