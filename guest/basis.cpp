#include "guest/basis.h"

namespace contort {

namespace {

Vec3 vector_of(Axis axis) {
  Vec3 out(0.0);
  out[static_cast<int>(axis) / 2] = static_cast<int>(axis) % 2 == 0 ? 1.0 : -1.0;
  return out;
}

}  // namespace

// In a right-handed system up x forward points to the left; in a left-handed one, to the right.
Basis::Basis(const GuestConvention& convention)
    : up_(vector_of(convention.up)),
      forward_(vector_of(convention.forward)),
      handedness_(convention.handed == Hand::right ? 1.0 : -1.0),
      unit_m_(convention.unit_m) {
  left_ = handedness_ * glm::cross(up_, forward_);
}

Vec3 Basis::direction(const Vec3& theirs) const {
  return {glm::dot(left_, theirs), glm::dot(up_, theirs), glm::dot(forward_, theirs)};
}

Quat Basis::rotation(double x, double y, double z, double w) const {
  const Vec3 v = axis(Vec3(x, y, z));
  return Quat(w, v.x, v.y, v.z);
}

}  // namespace contort
