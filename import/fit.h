// Fits capsules around the vertices of a bone.
#pragma once

#include <array>
#include <vector>

#include "model/character/inertia.h"
#include "model/character/shape.h"

namespace contort {

struct FittedBox {
  Vec3 center_m{0.0};
  std::array<Vec3, 3> axes{};      // unit, at right angles
  std::array<double, 3> half_m{};  // longest first
};

// The smallest box around the middle 96 % of the points, along the frame's axes, along the points' own main axes, or
// along `bone`.
FittedBox fit_box(const std::vector<Vec3>& points, const Vec3& bone);

// Returns one to four capsules that fill the volume of the points: one after another if it is long, side by side if
// it is flat. None is thinner than `least_radius_m`.
std::vector<Capsule> fit_capsules(const std::vector<Vec3>& points, const Vec3& bone, double least_radius_m);

// The unit eigenvectors of a symmetric matrix, in the order of falling eigenvalues (Jacobi's method).
struct Eigen3 {
  std::array<double, 3> values{};
  std::array<Vec3, 3> vectors{};
};
Eigen3 eigen_of(const Mat3& symmetric);

double volume_m3(const Capsule& capsule);
double volume_m3(const Box& box);

// Returns the inertia of a solid of that mass.
BodyInertia inertia_of(const Capsule& capsule, double mass_kg);
BodyInertia inertia_of(const Box& box, double mass_kg);

}  // namespace contort
