#include "model/motion/hinge_angles.h"

#include "model/core/detmath.h"

namespace contort {

Vec3 hinge_angles(const Vec3& first_axis, const Vec3& second_axis, const Vec3& third_axis, const Quat& rotation) {
  // In the basis of the three axes the rotation is Rx(a) Ry(b) Rz(c). In a left-handed basis the third axis is
  // reversed.
  const double hand = glm::dot(glm::cross(first_axis, second_axis), third_axis) < 0.0 ? -1.0 : 1.0;
  const Vec3 e[3] = {first_axis, second_axis, hand * third_axis};
  const auto entry = [&](int row, int column) { return glm::dot(e[row], rotation * e[column]); };
  const double a = det::atan2(-entry(1, 2), entry(2, 2));
  // b and c follow from Rx(-a) R = Ry(b) Rz(c), not from R, so that they fit the chosen a near b = +-pi/2, where a is
  // nearly arbitrary.
  const det::SinCos turn = det::sincos(a);
  const double b = det::atan2(entry(0, 2), turn.cos * entry(2, 2) - turn.sin * entry(1, 2));
  const double c =
      det::atan2(turn.cos * entry(1, 0) + turn.sin * entry(2, 0), turn.cos * entry(1, 1) + turn.sin * entry(2, 1));
  return {a, b, hand * c};
}

}  // namespace contort
