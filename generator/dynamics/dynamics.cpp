#include "generator/dynamics/dynamics.h"

#include <algorithm>

#include "generator/dynamics/recursions.h"
#include "model/core/detmath.h"
#include "model/core/index.h"

namespace contort {

namespace {

const RecursionSet& fastest() { return recursion_sets().back(); }

void place_root_freedoms(const Placement& root, SpatialMotion* out) {
  for (int k = 0; k < 3; ++k) {
    out[k] = {};
    out[k].linear[k] = 1.0;
    out[3 + k] = {root.rotation[k], Vec3(0.0)};
  }
}

// The root's origin moves: the acceleration of the body's point that is there differs from that of the motion about it.
// Gravity is an acceleration of the world upward.
void start_at_root(std::span<const double> velocity, std::span<const double> acceleration, double gravity_m_s2,
                   DynamicsScratch& scratch) {
  const WideMat3& r = scratch.world[0].rotation;
  const Vec3 angular = r * Vec3(velocity[3], velocity[4], velocity[5]);
  const Vec3 linear(velocity[0], velocity[1], velocity[2]);
  const Vec3 up(acceleration[0], acceleration[1] + gravity_m_s2, acceleration[2]);
  scratch.velocity[0] = {angular, linear};
  scratch.acceleration[0] = {r * Vec3(acceleration[3], acceleration[4], acceleration[5]),
                             up - glm::cross(angular, linear)};
}

// The motion of a link about the root's origin.
struct Carried {
  SpatialMotion velocity;
  SpatialMotion acceleration;
};

// The motion of a link without accelerations of any degree of freedom, as the recursion of inverse_dynamics has it.
Carried carried_to(const Multibody& body, const DynamicsScratch& scratch, int i, std::span<const double> velocity) {
  if (i == 0) {
    const Vec3 angular = scratch.world[0].rotation * Vec3(velocity[3], velocity[4], velocity[5]);
    const Vec3 linear(velocity[0], velocity[1], velocity[2]);
    return {{angular, linear}, {Vec3(0.0), -glm::cross(angular, linear)}};
  }
  const Link& link = body.links()[at(i)];
  Carried motion = carried_to(body, scratch, link.parent, velocity);
  SpatialMotion rate;
  for (std::size_t k = at(link.dof); k < at(link.dof + link.dof_count); ++k)
    rate += velocity[k] * scratch.freedoms[k];
  motion.velocity += rate;
  const SpatialMotion& v = motion.velocity;
  motion.acceleration += {glm::cross(v.angular.narrow(), rate.angular.narrow()),
                          glm::cross(v.angular.narrow(), rate.linear.narrow()) +
                              glm::cross(v.linear.narrow(), rate.angular.narrow())};
  return motion;
}

Vec3 acceleration_of_point(const Carried& link, const Vec3& from_root_m) {
  const SpatialMotion &v = link.velocity, &a = link.acceleration;
  return a.linear + glm::cross(a.angular.narrow(), from_root_m) +
         glm::cross(v.angular.narrow(), point_velocity(v, from_root_m));
}

Quat moved_on(const Quat& q, const Vec3& rate, double time_s) {
  return glm::normalize(q * from_rotation_vector(rate * time_s));
}

void subtract_scaled(double share, const Six& v, Six& sum) {
  for (std::size_t c = 0; c < v.size(); ++c) sum[c] -= share * v[c];
}

}  // namespace

void place(const Multibody& body, const Rigid& world_from_root, std::span<const double> coords,
           DynamicsScratch& scratch) {
  const auto links = body.links();
  scratch.angles_rad.resize(links.size());
  scratch.turns.resize(links.size());
  scratch.world.resize(links.size());
  scratch.inertia.resize(links.size());
  scratch.freedoms.resize(at(body.dof_count()));
  for (std::size_t i = 1; i < links.size(); ++i)
    scratch.angles_rad[i] = links[i].kind == JointKind::hinge ? coords[at(links[i].coord)] : 0.0;
  det::sincos(scratch.angles_rad, scratch.turns);
  scratch.world[0] = {glm::mat3_cast(world_from_root.q), world_from_root.p_m};
  place_root_freedoms(scratch.world[0], scratch.freedoms.data());
  fastest().place_links(body, coords, scratch);
}

SpatialInertia placed_inertia(double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_kg_m2,
                              const Placement& link, const Vec3& root_m) {
  SpatialInertia placed;
  fastest().place_mass(mass_kg, center_of_mass_m, lower_root(inertia_kg_m2), link, root_m, placed);
  return placed;
}

void inverse_dynamics(const Multibody& body, std::span<const double> velocity, std::span<const double> acceleration,
                      double gravity_m_s2, DynamicsScratch& scratch, std::span<double> forces) {
  const std::size_t count = body.links().size();
  scratch.velocity.resize(count);
  scratch.acceleration.resize(count);
  scratch.force.resize(count);
  start_at_root(velocity, acceleration, gravity_m_s2, scratch);
  fastest().sum_forces(body, velocity, acceleration, scratch, forces);
}

void mass_matrix(const Multibody& body, DynamicsScratch& scratch, std::span<double> matrix) {
  scratch.composite.resize(body.links().size());
  fastest().fill_mass_matrix(body, scratch, matrix);
}

void multiply(std::span<const double> matrix, std::span<const double> x, std::span<double> out) {
  fastest().multiply(matrix, x, out);
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
  for (std::size_t k = n; k-- > 0;) {
    if (x[k] == 0.0) continue;  // a force at one link reaches only the freedoms on its way to the root
    for (int i = parent[k]; i >= 0; i = parent[at(i)]) x[at(i)] -= factors[k * n + at(i)] * x[k];
  }
  for (std::size_t k = 0; k < n; ++k) {
    x[k] /= factors[k * n + k];
    for (int i = parent[k]; i >= 0; i = parent[at(i)]) x[k] -= factors[k * n + at(i)] * x[at(i)];
  }
}

void solve_six(const Multibody& body, std::span<const double> factors, std::span<Six> x) {
  const std::size_t n = x.size();
  const auto parent = body.parent_dof();
  for (std::size_t k = n; k-- > 0;) {
    if (x[k] == Six{}) continue;  // as in solve
    for (int i = parent[k]; i >= 0; i = parent[at(i)]) subtract_scaled(factors[k * n + at(i)], x[k], x[at(i)]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (double& entry : x[k]) entry /= factors[k * n + k];
    for (int i = parent[k]; i >= 0; i = parent[at(i)]) subtract_scaled(factors[k * n + at(i)], x[at(i)], x[k]);
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

SpatialMotion carried_acceleration(const Multibody& body, const DynamicsScratch& scratch, int link,
                                   const Vec3& point_world_m, std::span<const double> velocity) {
  const Carried carried = carried_to(body, scratch, link, velocity);
  return {carried.acceleration.angular, acceleration_of_point(carried, point_world_m - scratch.world[0].origin_m)};
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
