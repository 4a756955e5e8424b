// Mass properties of rigid bodies, and their combination when bodies are fixed to each other.
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

// Returns the properties of the body in frame a.
BodyInertia moved(const Rigid& a_from_b, const BodyInertia& body_b);

// Returns the properties of two bodies of one frame that are fixed to each other (parallel-axis theorem).
BodyInertia merged(const BodyInertia& first, const BodyInertia& second);

}  // namespace contort
