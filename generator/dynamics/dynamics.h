// Rigid-body dynamics of a floating tree, after R. Featherstone, "Rigid Body Dynamics Algorithms", 2008: inverse
// dynamics (RNEA, section 5.3), mass matrix (CRBA, 6.2), its factors along the tree (6.5), point Jacobians. Equation of
// motion:
//
//   M(q) a + h(q, v) = generalised forces,    h: gravity, Coriolis and centrifugal terms
//
// All bodies are written about one point, the root's origin, along the world's axes: motions then add along the tree
// and forces add back, without a change of frames between links, and the mass matrix, Jacobians and ground forces share
// the same axes. Fixed order of sums; no allocation once a scratch has been used.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "generator/dynamics/multibody.h"
#include "model/core/detmath.h"

namespace contort {

inline constexpr double kGravity_m_s2 = 9.81;

// A frame in the world, its rotation as a matrix.
struct Placement {
  WideMat3 rotation = Mat3(1.0);
  WideVec3 origin_m;
};

// The places of all bodies, and memory of the recursions over them. Spatial vectors: about world[0].origin_m.
struct DynamicsScratch {
  std::vector<double> angles_rad;       // angles of hinges, by link; 0 for others
  std::vector<det::SinCos> turns;       // sines and cosines of these
  std::vector<Placement> world;         // world_from_link
  std::vector<SpatialMotion> freedoms;  // by degree of freedom: the motion due to its unit rate
  std::vector<SpatialInertia> inertia;  // by link
  std::vector<SpatialMotion> velocity;
  std::vector<SpatialMotion> acceleration;
  std::vector<SpatialForce> force;
  std::vector<SpatialInertia> composite;  // inertia of each link with all its descendants
};

// Everything below uses the pose that was placed last.
void place(const Multibody& body, const Rigid& world_from_root, std::span<const double> coords,
           DynamicsScratch& scratch);

// A mass fixed to a link, about the root's origin.
SpatialInertia placed_inertia(double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_kg_m2,
                              const Placement& link, const Vec3& root_m);

// RNEA: forces = M a + h with gravity along -Y. Leaves velocities and accelerations in the scratch.
void inverse_dynamics(const Multibody& body, std::span<const double> velocity, std::span<const double> acceleration,
                      double gravity_m_s2, DynamicsScratch& scratch, std::span<double> forces);

// CRBA: M, symmetric, dof_count x dof_count row by row, of which only the entries (i, j) are written where i is on j's
// way to the root or j on i's: the rest of `matrix` must be 0 from before and stays so.
void mass_matrix(const Multibody& body, DynamicsScratch& scratch, std::span<double> matrix);

// out = M x of a symmetric matrix; entries of x that are 0 cost nothing.
void multiply(std::span<const double> matrix, std::span<const double> x, std::span<double> out);

// M = L^T D L in place of its lower triangle, without fill-in; then solves M x = b, x in place of b. M of bodies with
// mass is positive definite; a last link without mass gives infinities.
void factorise(const Multibody& body, std::span<double> matrix);
void solve(const Multibody& body, std::span<const double> factors, std::span<double> x);

// The same for six right-hand sides at once, in one pass over the factors: x[i] holds the entries of degree of freedom
// i.
using Six = std::array<double, 6>;
void solve_six(const Multibody& body, std::span<const double> factors, std::span<Six> x);

// Rows of the velocity of a point fixed to a link (m/s, world), 3 x dof_count, and of the link's angular velocity
// (rad/s, world). All entries are written.
void point_jacobian(const Multibody& body, const DynamicsScratch& scratch, int link, const Vec3& point_world_m,
                    std::span<double> rows);
void angular_jacobian(const Multibody& body, const DynamicsScratch& scratch, int link, std::span<double> rows);

// The acceleration that velocities alone cause at a point of a link, dJ/dt v: rad/s^2, and m/s^2 of the point (world).
// After place(); the velocities may be any.
SpatialMotion carried_acceleration(const Multibody& body, const DynamicsScratch& scratch, int link,
                                   const Vec3& point_world_m, std::span<const double> velocity);

// Moves a pose by generalised velocities over a time: the root's and balls' rotations by the exponential map.
void integrate(const Multibody& body, std::span<const double> velocity, double time_s, Rigid& world_from_root,
               std::span<double> coords);

}  // namespace contort
