#include "generator/dynamics/dynamics.h"

#include <algorithm>

#include "generator/core/detmath.h"

namespace contort {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

Placement place_link(const Link& link, const Placement& parent, const double* q) {
  const Vec3 origin_m = parent.origin_m + parent.rotation * link.origin_m;
  if (link.kind == JointKind::hinge) {
    const det::SinCos turn = det::sincos(q[0]);
    return {parent.rotation * (link.along + turn.cos * link.across + turn.sin * link.turned), origin_m};
  }
  if (link.kind == JointKind::prismatic)
    return {parent.rotation * link.rest, origin_m + parent.rotation * (q[0] * link.axis)};
  return {parent.rotation * (link.rest * glm::mat3_cast(Quat(q[0], q[1], q[2], q[3]))), origin_m};
}

// What a turn about an axis through a link's origin does, about the root's.
SpatialMotion turning(const Vec3& axis, const Vec3& origin_m) { return {axis, glm::cross(origin_m, axis)}; }

// Unit rates of a joint's freedoms. A ball's are along the axes of the body that it moves.
void place_freedoms(const Link& link, const Placement& parent, const Placement& own, const Vec3& from_root_m,
                    SpatialMotion* out) {
  if (link.kind == JointKind::hinge) out[0] = turning(parent.rotation * link.axis, from_root_m);
  if (link.kind == JointKind::prismatic) out[0] = {Vec3(0.0), parent.rotation * link.axis};
  if (link.kind == JointKind::ball)
    for (int k = 0; k < 3; ++k) out[k] = turning(own.rotation[k], from_root_m);
}

void place_root_freedoms(const Placement& root, SpatialMotion* out) {
  for (int k = 0; k < 3; ++k) {
    out[k] = {};
    out[k].linear[k] = 1.0;
    out[3 + k] = {root.rotation[k], Vec3(0.0)};
  }
}

// Inertia about the centre of mass turned, then moved: R I R^T + m (c.c 1 - c c^T).
SpatialInertia place_inertia(double mass_kg, const Vec3& center_of_mass_m, const Mat3& about_center, const Mat3& r,
                             const Vec3& from_root_m) {
  const Vec3 c = from_root_m + r * center_of_mass_m;
  const Mat3 half = r * about_center;
  Mat3 inertia;
  const double across = glm::dot(c, c);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) {
      const double turned = half[0][i] * r[0][j] + half[1][i] * r[1][j] + half[2][i] * r[2][j];
      inertia[i][j] = inertia[j][i] = turned + mass_kg * ((i == j ? across : 0.0) - c[i] * c[j]);
    }
  return {mass_kg, mass_kg * c, inertia};
}

SpatialInertia place_inertia(const Link& link, const Placement& own, const Vec3& from_root_m) {
  return place_inertia(link.mass_kg, link.center_of_mass_m, link.inertia_kg_m2, own.rotation, from_root_m);
}

SpatialMotion rate_of(const Link& link, const DynamicsScratch& scratch, std::span<const double> rates) {
  SpatialMotion sum = rates[at(link.dof)] * scratch.freedoms[at(link.dof)];
  for (int k = 1; k < link.dof_count; ++k) sum += rates[at(link.dof + k)] * scratch.freedoms[at(link.dof + k)];
  return sum;
}

// The root's origin moves: the acceleration of the body's point that is there differs from that of the motion about it.
// Gravity is an acceleration of the world upward.
void start_at_root(std::span<const double> velocity, std::span<const double> acceleration, double gravity_m_s2,
                   DynamicsScratch& scratch) {
  const Mat3& r = scratch.world[0].rotation;
  const Vec3 angular = r * Vec3(velocity[3], velocity[4], velocity[5]);
  const Vec3 linear(velocity[0], velocity[1], velocity[2]);
  const Vec3 up(acceleration[0], acceleration[1] + gravity_m_s2, acceleration[2]);
  scratch.velocity[0] = {angular, linear};
  scratch.acceleration[0] = {r * Vec3(acceleration[3], acceleration[4], acceleration[5]),
                             up - glm::cross(angular, linear)};
}

// Of a product with a vector that is nearly empty.
void add_columns(std::size_t n, std::span<const double> matrix, std::span<const double> x, std::span<double> out) {
  std::ranges::fill(out, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    if (x[k] == 0.0) continue;
    for (std::size_t i = 0; i < n; ++i) out[i] += matrix[std::max(i, k) * n + std::min(i, k)] * x[k];
  }
}

Quat turned(const Quat& q, const Vec3& rate, double time_s) {
  return glm::normalize(q * from_rotation_vector(rate * time_s));
}

}  // namespace

void place(const Multibody& body, const Rigid& world_from_root, std::span<const double> coords,
           DynamicsScratch& scratch) {
  const auto links = body.links();
  scratch.world.resize(links.size());
  scratch.inertia.resize(links.size());
  scratch.freedoms.resize(at(body.dof_count()));
  scratch.world[0] = {glm::mat3_cast(world_from_root.q), world_from_root.p_m};
  scratch.inertia[0] = place_inertia(links[0], scratch.world[0], Vec3(0.0));
  place_root_freedoms(scratch.world[0], scratch.freedoms.data());
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Link& link = links[i];
    const Placement& parent = scratch.world[at(link.parent)];
    const Placement own = scratch.world[i] = place_link(link, parent, &coords[at(link.coord)]);
    const Vec3 from_root_m = own.origin_m - world_from_root.p_m;
    place_freedoms(link, parent, own, from_root_m, &scratch.freedoms[at(link.dof)]);
    if (!link.massless) scratch.inertia[i] = place_inertia(link, own, from_root_m);
  }
}

SpatialInertia placed_inertia(double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_kg_m2,
                              const Placement& link, const Vec3& root_m) {
  return place_inertia(mass_kg, center_of_mass_m, inertia_kg_m2, link.rotation, link.origin_m - root_m);
}

void inverse_dynamics(const Multibody& body, std::span<const double> velocity, std::span<const double> acceleration,
                      double gravity_m_s2, DynamicsScratch& scratch, std::span<double> forces) {
  const auto links = body.links();
  scratch.velocity.resize(links.size());
  scratch.acceleration.resize(links.size());
  scratch.force.resize(links.size());
  start_at_root(velocity, acceleration, gravity_m_s2, scratch);
  scratch.force[0] = force_of(scratch.inertia[0], scratch.velocity[0], scratch.acceleration[0]);
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Link& link = links[i];
    const SpatialMotion rate = rate_of(link, scratch, velocity);
    SpatialMotion v = scratch.velocity[at(link.parent)], a = scratch.acceleration[at(link.parent)];
    v += rate;
    a += rate_of(link, scratch, acceleration);
    a += cross_motion(v, rate);
    scratch.velocity[i] = v, scratch.acceleration[i] = a;
    scratch.force[i] = link.massless ? SpatialForce{} : force_of(scratch.inertia[i], v, a);
  }
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    for (int k = link.dof; k < link.dof + link.dof_count; ++k)
      forces[at(k)] = dot(scratch.freedoms[at(k)], scratch.force[i]);
    if (i > 0) scratch.force[at(link.parent)] += scratch.force[i];
  }
}

void mass_matrix(const Multibody& body, DynamicsScratch& scratch, std::span<double> matrix) {
  const auto links = body.links();
  const auto parent_dof = body.parent_dof();
  const auto n = at(body.dof_count());
  scratch.composite.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i)
    scratch.composite[i] = links[i].massless ? SpatialInertia{} : scratch.inertia[i];
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    for (int k = link.dof; k < link.dof + link.dof_count; ++k) {
      const SpatialForce force = scratch.composite[i] * scratch.freedoms[at(k)];
      double* row = &matrix[at(k) * n];
      for (int j = k; j >= 0; j = parent_dof[at(j)]) row[j] = dot(scratch.freedoms[at(j)], force);
    }
    if (i > 0) scratch.composite[at(link.parent)] += scratch.composite[i];
  }
}

void multiply(const Multibody& body, std::span<const double> matrix, std::span<const double> x, std::span<double> out) {
  const auto n = at(body.dof_count());
  const auto parent = body.parent_dof();
  if (std::ranges::count(x, 0.0) + 3 >= static_cast<std::ptrdiff_t>(n)) return add_columns(n, matrix, x, out);
  for (std::size_t k = 0; k < n; ++k) {
    const double* row = &matrix[k * n];
    double sum = row[k] * x[k];
    for (int i = parent[k]; i >= 0; i = parent[at(i)]) {
      sum += row[i] * x[at(i)];
      out[at(i)] += row[i] * x[k];
    }
    out[k] = sum;
  }
}

void factorise(const Multibody& body, std::span<double> matrix) {
  const auto n = at(body.dof_count());
  const auto parent = body.parent_dof();
  for (std::size_t k = n; k-- > 0;) {
    double* row = &matrix[k * n];
    for (int i = parent[k]; i >= 0; i = parent[at(i)]) {
      const double share = row[i] / row[k];
      for (int j = i; j >= 0; j = parent[at(j)]) matrix[at(i) * n + at(j)] -= share * row[j];
      row[i] = share;
    }
  }
}

void solve(const Multibody& body, std::span<const double> factors, std::span<double> x) {
  const auto n = at(body.dof_count());
  const auto parent = body.parent_dof();
  for (std::size_t k = n; k-- > 0;)
    for (int i = parent[k]; i >= 0; i = parent[at(i)]) x[at(i)] -= factors[k * n + at(i)] * x[k];
  for (std::size_t k = 0; k < n; ++k) {
    x[k] /= factors[k * n + k];
    for (int i = parent[k]; i >= 0; i = parent[at(i)]) x[k] -= factors[k * n + at(i)] * x[at(i)];
  }
}

void point_jacobian(const Multibody& body, const DynamicsScratch& scratch, int link, const Vec3& point_world_m,
                    std::span<double> rows) {
  const auto n = at(body.dof_count());
  const Vec3 from_root_m = point_world_m - scratch.world[0].origin_m;
  std::fill(rows.begin(), rows.end(), 0.0);
  const Link& last = body.links()[at(link)];
  for (int j = last.dof + last.dof_count - 1; j >= 0; j = body.parent_dof()[at(j)]) {
    const SpatialMotion& freedom = scratch.freedoms[at(j)];
    const Vec3 moved = freedom.linear + glm::cross(freedom.angular, from_root_m);
    for (int k = 0; k < 3; ++k) rows[at(k) * n + at(j)] = moved[k];
  }
}

void angular_jacobian(const Multibody& body, const DynamicsScratch& scratch, int link, std::span<double> rows) {
  const auto n = at(body.dof_count());
  std::fill(rows.begin(), rows.end(), 0.0);
  const Link& last = body.links()[at(link)];
  for (int j = last.dof + last.dof_count - 1; j >= 0; j = body.parent_dof()[at(j)])
    for (int k = 0; k < 3; ++k) rows[at(k) * n + at(j)] = scratch.freedoms[at(j)].angular[k];
}

Vec3 point_acceleration(const DynamicsScratch& scratch, int link, const Vec3& point_world_m) {
  const SpatialMotion& v = scratch.velocity[at(link)];
  const SpatialMotion& a = scratch.acceleration[at(link)];
  const Vec3 from_root_m = point_world_m - scratch.world[0].origin_m;
  const Vec3 speed = v.linear + glm::cross(v.angular, from_root_m);
  return a.linear + glm::cross(a.angular, from_root_m) + glm::cross(v.angular, speed);
}

void integrate(const Multibody& body, std::span<const double> velocity, double time_s, Rigid& world_from_root,
               std::span<double> coords) {
  world_from_root.p_m += time_s * Vec3(velocity[0], velocity[1], velocity[2]);
  world_from_root.q = turned(world_from_root.q, Vec3(velocity[3], velocity[4], velocity[5]), time_s);
  for (const Link& link : body.links().subspan(1)) {
    double* q = &coords[at(link.coord)];
    const double* rate = &velocity[at(link.dof)];
    if (link.kind != JointKind::ball) {
      q[0] += time_s * rate[0];
      continue;
    }
    const Quat now = turned(Quat(q[0], q[1], q[2], q[3]), Vec3(rate[0], rate[1], rate[2]), time_s);
    q[0] = now.w, q[1] = now.x, q[2] = now.y, q[3] = now.z;
  }
}

}  // namespace contort
