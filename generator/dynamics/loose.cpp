#include "generator/dynamics/loose.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kNear_m = 0.02;          // beyond what a tick covers, points nearer than this are looked at
constexpr double kFarthestTouch_m = 1.0;  // farther than anything gets in a tick
constexpr double kRecovery_per_s = 5.0;   // of depth
constexpr double kFastestRecovery_m_s = 0.5;

void add_points(const Collider& collider, std::vector<TouchPoint>& out) {
  const auto add = [&](const Vec3& point, double radius) { out.push_back({collider.joint, point, radius, false}); };
  if (const Sphere* sphere = std::get_if<Sphere>(&collider.shape)) add(sphere->center_m, sphere->radius_m);
  if (const Capsule* capsule = std::get_if<Capsule>(&collider.shape))
    add(capsule->a_m, capsule->radius_m), add(capsule->b_m, capsule->radius_m);
  if (const Polyhedron* hull = collider.polyhedron.get())
    for (const Vec3& corner : hull->corners_m) add(hull->center_m + corner, 0.0);
  const Box* box = std::get_if<Box>(&collider.shape);
  if (box == nullptr) return;
  const Quat q = from_rotation_vector(box->rotation_deg * kRadPerDeg);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    add(box->center_m + q * (sign * box->half_m), 0.0);
  }
}

// Velocities of links. Points of one link, which follow each other, share its own.
class LinkSpeeds {
 public:
  LinkSpeeds(const Multibody& body, const DynamicsScratch& dynamics, std::span<const double> velocity)
      : body_(body), dynamics_(dynamics), velocity_(velocity) {}

  // From the root's origin.
  Vec3 of_point(int link, const Vec3& from_root_m) {
    if (link != link_) link_ = link, motion_ = motion_of(link);
    return point_velocity(motion_, from_root_m);
  }

 private:
  SpatialMotion motion_of(int link) const {
    SpatialMotion v;
    const Link& last = body_.links()[at(link)];
    for (int k = last.dof + last.dof_count - 1; k >= 0; k = body_.parent_dof()[at(k)])
      v += velocity_[at(k)] * dynamics_.freedoms[at(k)];
    return v;
  }

  const Multibody& body_;
  const DynamicsScratch& dynamics_;
  std::span<const double> velocity_;
  int link_ = -1;
  SpatialMotion motion_;
};

// Factorises a symmetric matrix of six rows, as factorise_symmetric does.
using RootFactors = std::array<double, 36>;

// The inertia that everything together has about the root's origin: (moment, force) from (angular, linear).
RootFactors factorised(const SpatialInertia& inertia) {
  RootFactors factors;
  for (std::size_t k = 0; k < 6; ++k) {
    SpatialMotion unit;
    (k < 3 ? unit.angular : unit.linear)[static_cast<int>(k % 3)] = 1.0;
    const SpatialForce column = inertia * unit;
    for (std::size_t i = 0; i < 6; ++i)
      factors[i * 6 + k] = i < 3 ? column.moment[static_cast<int>(i)] : column.force[static_cast<int>(i - 3)];
  }
  factorise_symmetric(factors, 6);
  return factors;
}

SpatialMotion moved_by(const RootFactors& factors, const SpatialForce& impulse) {
  double x[6];
  for (int k = 0; k < 3; ++k) x[k] = impulse.moment[k], x[3 + k] = impulse.force[k];
  solve_factorised(factors, 6, x);
  return {Vec3(x[0], x[1], x[2]), Vec3(x[3], x[4], x[5])};
}

void move_root(const DynamicsScratch& dynamics, const SpatialMotion& change, std::span<double> velocity) {
  const Vec3 turn = glm::transpose(Mat3(dynamics.world[0].rotation)) * change.angular;
  for (int k = 0; k < 3; ++k) velocity[at(k)] += change.linear[k], velocity[at(3 + k)] += turn[k];
}

// The speed along the normal, m/s, with which a point does not sink in within a tick, or comes out if it is inside.
double least_speed(double gap_m, double tick_s) {
  return gap_m > 0.0 ? -gap_m / tick_s : std::min(-kRecovery_per_s * gap_m, kFastestRecovery_m_s);
}

}  // namespace

std::vector<TouchPoint> touch_points(const Character& character, const DynamicFigure& figure) {
  std::vector<TouchPoint> points;
  for (const Sole& sole : figure.soles)
    for (const Vec3& corner : sole.corners_m) points.push_back({sole.link, corner, 0.0, true});
  const auto stands = [&](int link) {
    return std::ranges::any_of(figure.soles, [&](const Sole& sole) { return sole.link == link; });
  };
  for (const Collider& collider : character.colliders())
    if (!stands(collider.joint)) add_points(collider, points);
  return points;
}

void fall_freely(const Multibody& body, std::span<const double> mass, std::span<double> acceleration,
                 std::span<double> forces) {
  const auto n = static_cast<std::size_t>(body.dof_count());
  RootFactors factors{};
  double change[kRootDofs];
  for (std::size_t i = 0; i < kRootDofs; ++i) {
    change[i] = -forces[i];
    for (std::size_t j = 0; j <= i; ++j) factors[i * kRootDofs + j] = mass[i * n + j];
  }
  solve_symmetric(factors, kRootDofs, change);
  for (std::size_t k = 0; k < kRootDofs; ++k) acceleration[k] += change[k];
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < kRootDofs; ++k) forces[i] += mass[i * n + k] * change[k];
}

SpatialForce momentum_of(const Multibody& body, const DynamicsScratch& dynamics, std::span<const double> mass,
                         std::span<const double> velocity) {
  const auto n = at(body.dof_count());
  double root[kRootDofs] = {};
  for (std::size_t r = 0; r < kRootDofs; ++r)
    for (std::size_t k = 0; k < n; ++k) root[r] += mass[r * n + k] * velocity[k];
  return {dynamics.world[0].rotation * Vec3(root[3], root[4], root[5]), Vec3(root[0], root[1], root[2])};
}

void set_momentum(const Multibody& body, const DynamicsScratch& dynamics, std::span<const double> mass,
                  const SpatialForce& momentum, std::span<double> velocity) {
  const SpatialForce now = momentum_of(body, dynamics, mass, velocity);
  const SpatialForce missing{momentum.moment - now.moment, momentum.force - now.force};
  move_root(dynamics, moved_by(factorised(dynamics.composite[0]), missing), velocity);
}

SpatialForce weight_of(const DynamicsScratch& dynamics) {
  const Vec3 down(0.0, -kGravity_m_s2, 0.0);
  return {glm::cross(dynamics.composite[0].first_moment, down), dynamics.composite[0].mass_kg * down};
}

void add_touches(const DynamicFigure& figure, std::span<const TouchPoint> points, const Environment& environment,
                 double tick_s, std::span<const double> velocity, const DynamicsScratch& dynamics,
                 ContactSolver& solver) {
  LinkSpeeds speeds(figure.body, dynamics, velocity);
  for (const TouchPoint& touch : points) {
    const Placement& link = dynamics.world[at(touch.link)];
    const Vec3 center = link.origin_m + link.rotation * touch.point_m;
    const auto meet = [&](const Surface& surface) {
      const double gap_m = surface.distance_m - touch.radius_m;
      if (!(gap_m < kFarthestTouch_m)) return;
      const Vec3 from_root = center - touch.radius_m * surface.normal - dynamics.world[0].origin_m;
      const double sinking = glm::dot(surface.normal, speeds.of_point(touch.link, from_root));
      if (!(gap_m < kNear_m - tick_s * sinking)) return;
      solver.add_touch({touch.link, from_root, surface.normal, least_speed(gap_m, tick_s), 0.0, touch.is_sole});
    };
    if (!environment.is_surely_over_ground(center, touch.radius_m, kFarthestTouch_m))
      meet(environment.nearest_ground(center));
    if (!environment.obstacles().empty()) meet(environment.nearest_obstacle(center));
  }
}

}  // namespace contort
