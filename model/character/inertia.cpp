#include "model/character/inertia.h"

namespace contort {

namespace {

// m (d.d 1 - d dT): the inertia of a point mass at d about the origin.
Mat3 point_inertia(double mass_kg, const Vec3& d) {
  return mass_kg * (glm::dot(d, d) * Mat3(1.0) - glm::outerProduct(d, d));
}

}  // namespace

BodyInertia principal_inertia(double mass_kg, const Vec3& center_m, const Vec3& moments_kg_m2) {
  Mat3 inertia(0.0);
  for (int i = 0; i < 3; ++i) inertia[i][i] = moments_kg_m2[i];
  return {mass_kg, center_m, inertia};
}

BodyInertia moved(const Rigid& a_from_b, const BodyInertia& body_b) {
  const Mat3 r = glm::mat3_cast(a_from_b.q);
  return {body_b.mass_kg, a_from_b * body_b.center_m, r * body_b.inertia_kg_m2 * glm::transpose(r)};
}

BodyInertia merged(const BodyInertia& first, const BodyInertia& second) {
  const double mass_kg = first.mass_kg + second.mass_kg;
  if (mass_kg <= 0.0) return {};
  const Vec3 center_m = (first.mass_kg * first.center_m + second.mass_kg * second.center_m) / mass_kg;
  return {mass_kg, center_m,
          first.inertia_kg_m2 + second.inertia_kg_m2 + point_inertia(first.mass_kg, first.center_m - center_m) +
              point_inertia(second.mass_kg, second.center_m - center_m)};
}

}  // namespace contort
