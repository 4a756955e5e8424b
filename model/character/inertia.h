// Mass properties of rigid bodies, and how fixed bodies become one.
#pragma once

#include "model/core/math.h"

namespace contort {

struct BodyInertia {
  double mass_kg = 0.0;
  Vec3 center_m{0.0};       // centre of mass
  Mat3 inertia_kg_m2{0.0};  // about the centre of mass
  bool operator==(const BodyInertia&) const = default;
};

BodyInertia principal_inertia(double mass_kg, const Vec3& center_m, const Vec3& moments_kg_m2);

// The same body seen from frame a.
BodyInertia moved(const Rigid& a_from_b, const BodyInertia& body_b);

// Two bodies of one frame, fixed to each other (parallel-axis theorem).
BodyInertia merged(const BodyInertia& first, const BodyInertia& second);

}  // namespace contort
