#include "generator/dynamics/rotation_rates.h"

#include <cmath>

#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kSmall2 = 1e-6;  // below, the series' first terms are exact to 1e-13

}  // namespace

// 1 + [r]/2 + (1/a^2 - (1 + cos a)/(2 a sin a)) [r]^2, the last with half angles
Vec3 rotation_vector_rate(const Vec3& rotation, const Vec3& angular_velocity) {
  const double angle2 = glm::dot(rotation, rotation);
  double share = 1.0 / 12.0 + angle2 / 720.0;
  if (angle2 > kSmall2) {
    const double angle = std::sqrt(angle2);
    const det::SinCos half = det::sincos(0.5 * angle);
    share = (1.0 - 0.5 * angle * half.cos / half.sin) / angle2;
  }
  const Vec3 across = glm::cross(rotation, angular_velocity);
  return angular_velocity + 0.5 * across + share * glm::cross(rotation, across);
}

// 1 - (1 - cos a)/a^2 [r] + (a - sin a)/a^3 [r]^2
Vec3 angular_velocity_of(const Vec3& rotation, const Vec3& rotation_rate) {
  const double angle2 = glm::dot(rotation, rotation);
  double first = 0.5 - angle2 / 24.0, second = 1.0 / 6.0 - angle2 / 120.0;
  if (angle2 > kSmall2) {
    const double angle = std::sqrt(angle2);
    const det::SinCos whole = det::sincos(angle);
    first = (1.0 - whole.cos) / angle2;
    second = (angle - whole.sin) / (angle2 * angle);
  }
  const Vec3 across = glm::cross(rotation, rotation_rate);
  return rotation_rate - first * across + second * glm::cross(rotation, across);
}

}  // namespace contort
