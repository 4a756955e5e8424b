// Forward dynamics by the articulated-body algorithm (Featherstone 2008, section 7.3) in plain 6 x 6 arrays: an oracle
// that shares only the tree and its placed frames with the recursions under test.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "generator/dynamics/dynamics.h"

namespace contort::fixtures {

using Six = std::array<double, 6>;
using SixBySix = std::array<Six, 6>;

inline Six times(const SixBySix& m, const Six& v) {
  Six out{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) out[i] += m[i][j] * v[j];
  return out;
}
inline Six transposed_times(const SixBySix& m, const Six& v) {
  Six out{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) out[j] += m[i][j] * v[i];
  return out;
}
inline SixBySix product(const SixBySix& a, const SixBySix& b) {
  SixBySix out{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t k = 0; k < 6; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}
inline double dot(const Six& a, const Six& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

inline void put(SixBySix& m, std::size_t row, std::size_t column, const Mat3& block) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m[row + static_cast<std::size_t>(i)][column + static_cast<std::size_t>(j)] = block[j][i];
}
inline Mat3 cross_of(const Vec3& a) { return {Vec3(0, a.z, -a.y), Vec3(-a.z, 0, a.x), Vec3(a.y, -a.x, 0)}; }

// A child's frame in its parent's.
inline Placement relative(const Placement& parent, const Placement& child) {
  const Mat3 back = glm::transpose(Mat3(parent.rotation));
  return {back * Mat3(child.rotation), back * (child.origin_m - parent.origin_m)};
}

// Motions of the parent into the child's frame.
inline SixBySix motion_transform(const Placement& x) {
  SixBySix m{};
  const Mat3 e = glm::transpose(Mat3(x.rotation));
  put(m, 0, 0, e), put(m, 3, 3, e), put(m, 3, 0, -1.0 * e * cross_of(x.origin_m));
  return m;
}
inline SixBySix matrix_of(const Link& link) {
  SixBySix m{};
  const Mat3 c = cross_of(link.center_of_mass_m);
  put(m, 0, 0, link.inertia_kg_m2 - link.mass_kg * (c * c)), put(m, 0, 3, link.mass_kg * c);
  put(m, 3, 0, -link.mass_kg * c), put(m, 3, 3, Mat3(link.mass_kg));
  return m;
}
inline Six crossed(const Six& v, const Six& m) {
  const Vec3 w(v[0], v[1], v[2]), u(v[3], v[4], v[5]), a(m[0], m[1], m[2]), b(m[3], m[4], m[5]);
  const Vec3 top = glm::cross(w, a), low = glm::cross(w, b) + glm::cross(u, a);
  return {top.x, top.y, top.z, low.x, low.y, low.z};
}
inline Six crossed_force(const Six& v, const Six& f) {
  const Vec3 w(v[0], v[1], v[2]), u(v[3], v[4], v[5]), n(f[0], f[1], f[2]), g(f[3], f[4], f[5]);
  const Vec3 top = glm::cross(w, n) + glm::cross(u, g), low = glm::cross(w, g);
  return {top.x, top.y, top.z, low.x, low.y, low.z};
}

// Solves a dense system by elimination with pivots.
template <std::size_t N>
std::array<double, N> solved(std::array<std::array<double, N>, N> m, std::array<double, N> b) {
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t best = k;
    for (std::size_t i = k; i < N; ++i)
      if (std::fabs(m[i][k]) > std::fabs(m[best][k])) best = i;
    std::swap(m[k], m[best]), std::swap(b[k], b[best]);
    for (std::size_t i = k + 1; i < N; ++i) {
      const double share = m[i][k] / m[k][k];
      for (std::size_t j = k; j < N; ++j) m[i][j] -= share * m[k][j];
      b[i] -= share * b[k];
    }
  }
  for (std::size_t k = N; k-- > 0;) {
    for (std::size_t j = k + 1; j < N; ++j) b[k] -= m[k][j] * b[j];
    b[k] /= m[k][k];
  }
  return b;
}

// A ball's three columns are handled at once here: three hinges, two of them without inertia, would not be the same
// joint.
inline std::vector<double> articulated_body_acceleration(const Multibody& body, const DynamicsScratch& scratch,
                                                         std::span<const double> velocity,
                                                         std::span<const double> forces, double gravity_m_s2) {
  const auto links = body.links();
  const std::size_t count = links.size();
  std::vector<SixBySix> to_link(count), inertia(count);
  std::vector<Six> v(count), c(count), bias(count);
  std::vector<std::vector<Six>> columns(count);
  const Mat3& r = scratch.world[0].rotation;
  const Vec3 linear = Vec3(velocity[0], velocity[1], velocity[2]) * r;
  v[0] = {velocity[3], velocity[4], velocity[5], linear.x, linear.y, linear.z};
  for (std::size_t i = 0; i < count; ++i) {
    inertia[i] = matrix_of(links[i]);
    if (i > 0) {
      to_link[i] =
          motion_transform(relative(scratch.world[static_cast<std::size_t>(links[i].parent)], scratch.world[i]));
      v[i] = times(to_link[i], v[static_cast<std::size_t>(links[i].parent)]);
      Six rate{};
      for (int k = 0; k < links[i].dof_count; ++k) {
        Six column{};
        const Vec3 axis =
            links[i].kind == JointKind::ball ? Vec3(k == 0, k == 1, k == 2) : links[i].axis * links[i].rest;
        const std::size_t from = links[i].kind == JointKind::prismatic ? 3 : 0;
        for (int j = 0; j < 3; ++j) column[from + static_cast<std::size_t>(j)] = axis[j];
        columns[i].push_back(column);
        for (std::size_t j = 0; j < 6; ++j) rate[j] += column[j] * velocity[static_cast<std::size_t>(links[i].dof + k)];
      }
      for (std::size_t j = 0; j < 6; ++j) v[i][j] += rate[j];
      c[i] = crossed(v[i], rate);
    }
    bias[i] = crossed_force(v[i], times(inertia[i], v[i]));
  }
  // Inward. U = I S, D = S^T U; for a ball D is 3 x 3.
  std::vector<std::vector<Six>> u(count);
  std::vector<std::array<std::array<double, 3>, 3>> d(count);
  std::vector<std::array<double, 3>> rest(count);
  const auto padded = [&](std::size_t i) {
    auto full = d[i];
    for (std::size_t k = columns[i].size(); k < 3; ++k) full[k][k] = 1.0;
    return full;
  };
  for (std::size_t i = count; i-- > 1;) {
    for (std::size_t k = 0; k < columns[i].size(); ++k) u[i].push_back(times(inertia[i], columns[i][k]));
    for (std::size_t k = 0; k < columns[i].size(); ++k) {
      for (std::size_t l = 0; l < columns[i].size(); ++l) d[i][k][l] = dot(columns[i][k], u[i][l]);
      rest[i][k] = forces[static_cast<std::size_t>(links[i].dof) + k] - dot(columns[i][k], bias[i]);
    }
    SixBySix articulated = inertia[i];
    Six force = bias[i];
    const std::array<double, 3> gain = solved<3>(padded(i), rest[i]);
    for (std::size_t row = 0; row < 6; ++row) {
      std::array<double, 3> unit{};
      for (std::size_t k = 0; k < columns[i].size(); ++k) unit[k] = u[i][k][row];
      const std::array<double, 3> share = solved<3>(padded(i), unit);
      for (std::size_t column = 0; column < 6; ++column)
        for (std::size_t k = 0; k < columns[i].size(); ++k) articulated[row][column] -= share[k] * u[i][k][column];
    }
    const Six extra = times(articulated, c[i]);
    for (std::size_t row = 0; row < 6; ++row) {
      force[row] += extra[row];
      for (std::size_t k = 0; k < columns[i].size(); ++k) force[row] += u[i][k][row] * gain[k];
    }
    const auto parent = static_cast<std::size_t>(links[i].parent);
    SixBySix transposed{};
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < 6; ++b) transposed[a][b] = to_link[i][b][a];
    const SixBySix carried = product(transposed, product(articulated, to_link[i]));
    const Six carried_force = transposed_times(to_link[i], force);
    for (std::size_t a = 0; a < 6; ++a) {
      bias[parent][a] += carried_force[a];
      for (std::size_t b = 0; b < 6; ++b) inertia[parent][a][b] += carried[a][b];
    }
  }
  // Outward.
  std::vector<double> out(static_cast<std::size_t>(body.dof_count()));
  std::vector<Six> a(count);
  const Vec3 pull = Vec3(forces[0], forces[1], forces[2]) * r;
  Six wrench{forces[3], forces[4], forces[5], pull.x, pull.y, pull.z};
  for (std::size_t k = 0; k < 6; ++k) wrench[k] -= bias[0][k];
  a[0] = solved<6>(inertia[0], wrench);
  const Vec3 angular(velocity[3], velocity[4], velocity[5]);
  const Vec3 root = r * (Vec3(a[0][3], a[0][4], a[0][5]) + glm::cross(angular, linear)) - Vec3(0, gravity_m_s2, 0);
  out[0] = root.x, out[1] = root.y, out[2] = root.z;
  for (std::size_t k = 0; k < 3; ++k) out[3 + k] = a[0][k];
  for (std::size_t i = 1; i < count; ++i) {
    a[i] = times(to_link[i], a[static_cast<std::size_t>(links[i].parent)]);
    for (std::size_t k = 0; k < 6; ++k) a[i][k] += c[i][k];
    std::array<double, 3> left = rest[i];
    for (std::size_t k = 0; k < columns[i].size(); ++k) left[k] -= dot(u[i][k], a[i]);
    const std::array<double, 3> rates = solved<3>(padded(i), left);
    for (std::size_t k = 0; k < columns[i].size(); ++k) {
      out[static_cast<std::size_t>(links[i].dof) + k] = rates[k];
      for (std::size_t j = 0; j < 6; ++j) a[i][j] += columns[i][k][j] * rates[k];
    }
  }
  return out;
}

}  // namespace contort::fixtures
