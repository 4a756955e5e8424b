#include "generator/dynamics/dynamics.h"

#include <algorithm>

#include "generator/core/detmath.h"

namespace contort {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// What a turn about an axis through a link's origin does, about the root's.
void put_turning(const Vec3& axis, const Vec3& origin_m, SpatialMotion& out) {
  out.angular = axis;
  out.linear = glm::cross(origin_m, axis);
}

// R v, by columns: these are written and read whole, and a processor waits where it reads across two fresh writes.
inline Vec3 turned(const Mat3& r, const Vec3& v) { return v.x * r[0] + v.y * r[1] + v.z * r[2]; }

// A hinge about its frame's axis k turns the other two columns.
void turn_columns(int k, double sin, double cos, const Mat3& from, Mat3& to) {
  constexpr static int kAxes[] = {0, 1, 2, 0, 1};
  const int i = kAxes[k + 1], j = kAxes[k + 2];
  const Vec3 first = cos * from[i] + sin * from[j];
  to[j] = cos * from[j] - sin * from[i];
  to[i] = first;
  to[k] = from[k];
}

// Rodrigues' formula, about any unit vector.
void turn_about(const Vec3& axis, double sin, double cos, const Mat3& from, Mat3& to) {
  for (int k = 0; k < 3; ++k)
    to[k] = cos * from[k] + sin * glm::cross(axis, from[k]) + ((1.0 - cos) * glm::dot(axis, from[k])) * axis;
}

// Turns a hinge's frame from where it rests; its axis in the world.
Vec3 turn_hinge(const Link& link, const Placement& parent, const det::SinCos& turn, const Mat3& from, Mat3& to) {
  if (link.turns_about >= 0) {
    turn_columns(link.turns_about, link.sense * turn.sin, turn.cos, from, to);
    return link.sense * from[link.turns_about];
  }
  const Vec3 axis = turned(parent.rotation, link.axis);
  turn_about(axis, turn.sin, turn.cos, from, to);
  return axis;
}

// Places a link, with the unit rates of its freedoms. A ball's are along the axes of the body that it moves.
void place_link(const Link& link, const Placement& parent, const Vec3& root_m, const double* q, const det::SinCos& turn,
                Placement& own, SpatialMotion* freedoms) {
  const Vec3 origin_m = parent.origin_m + turned(parent.rotation, link.origin_m);
  own.origin_m = origin_m;
  if (!link.is_straight) own.rotation = parent.rotation * link.rest;
  const Mat3& from = link.is_straight ? parent.rotation : own.rotation;
  if (link.kind == JointKind::hinge) {
    put_turning(turn_hinge(link, parent, turn, from, own.rotation), origin_m - root_m, freedoms[0]);
  } else if (link.kind == JointKind::prismatic) {
    own.rotation = from;
    freedoms[0] = {Vec3(0.0), turned(parent.rotation, link.axis)};
    own.origin_m += q[0] * freedoms[0].linear;
  } else {
    own.rotation = from * glm::mat3_cast(Quat(q[0], q[1], q[2], q[3]));
    for (int k = 0; k < 3; ++k) put_turning(own.rotation[k], origin_m - root_m, freedoms[k]);
  }
}

void place_root_freedoms(const Placement& root, SpatialMotion* out) {
  for (int k = 0; k < 3; ++k) {
    out[k] = {};
    out[k].linear[k] = 1.0;
    out[3 + k] = {root.rotation[k], Vec3(0.0)};
  }
}

// Inertia about the centre of mass turned, then moved: (R L) (R L)^T + m (c.c 1 - c c^T), c from the root.
void place_inertia(double mass_kg, const Vec3& center_of_mass_m, const Mat3& root, const Mat3& r,
                   const Vec3& from_root_m, SpatialInertia& out) {
  const Vec3 c = from_root_m + turned(r, center_of_mass_m);
  const Vec3 moment = mass_kg * c;
  const Vec3 square = moment * c;
  const Vec3 u = root[0].x * r[0] + root[0].y * r[1] + root[0].z * r[2];
  const Vec3 v = root[1].y * r[1] + root[1].z * r[2];
  const Vec3 w = root[2].z * r[2];
  out.mass_kg = mass_kg;
  out.first_moment = moment;
  out.inertia.diagonal = u * u + v * v + w * w + Vec3(square.y + square.z, square.x + square.z, square.x + square.y);
  out.inertia.beside = {u.y * u.z + v.y * v.z + w.y * w.z - moment.y * c.z,
                        u.x * u.z + v.x * v.z + w.x * w.z - moment.x * c.z,
                        u.x * u.y + v.x * v.y + w.x * w.y - moment.x * c.y};
}

void place_inertia(const Link& link, const Placement& own, const Vec3& root_m, SpatialInertia& out) {
  place_inertia(link.mass_kg, link.center_of_mass_m, link.inertia_root, own.rotation, own.origin_m - root_m, out);
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

// A link moves as its parent does, and as its own freedoms.
void add_joint(const Link& link, std::span<const double> velocity, std::span<const double> acceleration, std::size_t i,
               DynamicsScratch& scratch) {
  const std::size_t first = at(link.dof);
  SpatialMotion rate = velocity[first] * scratch.freedoms[first];
  SpatialMotion change = acceleration[first] * scratch.freedoms[first];
  for (std::size_t k = first + 1; k < first + at(link.dof_count); ++k)
    rate += velocity[k] * scratch.freedoms[k], change += acceleration[k] * scratch.freedoms[k];
  SpatialMotion& v = scratch.velocity[i];
  v = scratch.velocity[at(link.parent)] + rate;
  scratch.acceleration[i] = scratch.acceleration[at(link.parent)] + change + cross_motion(v, rate);
}

// Of a product with a vector that is nearly empty.
void add_columns(std::size_t n, std::span<const double> matrix, std::span<const double> x, std::span<double> out) {
  std::ranges::fill(out, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    if (x[k] == 0.0) continue;
    for (std::size_t i = 0; i < n; ++i) out[i] += matrix[std::max(i, k) * n + std::min(i, k)] * x[k];
  }
}

Quat moved_on(const Quat& q, const Vec3& rate, double time_s) {
  return glm::normalize(q * from_rotation_vector(rate * time_s));
}

}  // namespace

void place(const Multibody& body, const Rigid& world_from_root, std::span<const double> coords,
           DynamicsScratch& scratch) {
  const auto links = body.links();
  scratch.turns.resize(links.size());
  scratch.world.resize(links.size());
  scratch.inertia.resize(links.size());
  scratch.freedoms.resize(at(body.dof_count()));
  for (std::size_t i = 1; i < links.size(); ++i)
    if (links[i].kind == JointKind::hinge) scratch.turns[i] = det::sincos(coords[at(links[i].coord)]);
  scratch.world[0] = {glm::mat3_cast(world_from_root.q), world_from_root.p_m};
  place_root_freedoms(scratch.world[0], scratch.freedoms.data());
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Link& link = links[i];
    place_link(link, scratch.world[at(link.parent)], world_from_root.p_m, &coords[at(link.coord)], scratch.turns[i],
               scratch.world[i], &scratch.freedoms[at(link.dof)]);
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    if (!links[i].massless) place_inertia(links[i], scratch.world[i], world_from_root.p_m, scratch.inertia[i]);
}

SpatialInertia placed_inertia(double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_kg_m2,
                              const Placement& link, const Vec3& root_m) {
  SpatialInertia placed;
  place_inertia(mass_kg, center_of_mass_m, lower_root(inertia_kg_m2), link.rotation, link.origin_m - root_m, placed);
  return placed;
}

void inverse_dynamics(const Multibody& body, std::span<const double> velocity, std::span<const double> acceleration,
                      double gravity_m_s2, DynamicsScratch& scratch, std::span<double> forces) {
  const auto links = body.links();
  scratch.velocity.resize(links.size());
  scratch.acceleration.resize(links.size());
  scratch.force.resize(links.size());
  start_at_root(velocity, acceleration, gravity_m_s2, scratch);
  for (std::size_t i = 1; i < links.size(); ++i) add_joint(links[i], velocity, acceleration, i, scratch);
  for (std::size_t i = 0; i < links.size(); ++i)
    if (links[i].massless)
      scratch.force[i] = {};
    else
      put_force_of(scratch.inertia[i], scratch.velocity[i], scratch.acceleration[i], scratch.force[i]);
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
  const Mat3& root = scratch.world[0].rotation;
  scratch.composite.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i)
    scratch.composite[i] = links[i].massless ? SpatialInertia{} : scratch.inertia[i];
  for (std::size_t i = links.size(); i-- > 1;) {
    const Link& link = links[i];
    for (int k = link.dof; k < link.dof + link.dof_count; ++k) {
      const SpatialForce force = scratch.composite[i] * scratch.freedoms[at(k)];
      double* row = &matrix[at(k) * n];
      for (int j = k; j >= kRootDofs; j = parent_dof[at(j)]) row[j] = dot(scratch.freedoms[at(j)], force);
      for (int j = 0; j < 3; ++j) row[j] = force.force[j], row[3 + j] = glm::dot(root[j], force.moment);
    }
    scratch.composite[at(link.parent)] += scratch.composite[i];
  }
  for (int k = 0; k < kRootDofs; ++k) {
    const SpatialForce force = scratch.composite[0] * scratch.freedoms[at(k)];
    for (int j = 0; j <= k; ++j) matrix[at(k) * n + at(j)] = dot(scratch.freedoms[at(j)], force);
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
  world_from_root.q = moved_on(world_from_root.q, Vec3(velocity[3], velocity[4], velocity[5]), time_s);
  for (const Link& link : body.links().subspan(1)) {
    double* q = &coords[at(link.coord)];
    const double* rate = &velocity[at(link.dof)];
    if (link.kind != JointKind::ball) {
      q[0] += time_s * rate[0];
      continue;
    }
    const Quat now = moved_on(Quat(q[0], q[1], q[2], q[3]), Vec3(rate[0], rate[1], rate[2]), time_s);
    q[0] = now.w, q[1] = now.x, q[2] = now.y, q[3] = now.z;
  }
}

}  // namespace contort
