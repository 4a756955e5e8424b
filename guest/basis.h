// Conversion from a generator's axes, hand and unit to ours: y up, z forward, right-handed, metres.
#pragma once

#include "guest/manifest.h"
#include "model/core/math.h"

namespace contort {

// All frames of reference, also those of joints, are converted to our axes. So a joint's local rotation R becomes B R
// B^-1, where the rows of B are our axes in the generator's coordinates. A quaternion keeps its w, and its vector
// becomes det(B) B v.
class Basis {
 public:
  explicit Basis(const GuestConvention& convention);

  Vec3 direction(const Vec3& theirs) const;
  Vec3 point_m(const Vec3& theirs) const { return unit_m_ * direction(theirs); }
  // Converts an axis of rotation. Positive angles stay positive, so in a left-handed system the axis is reversed.
  Vec3 axis(const Vec3& theirs) const { return handedness_ * direction(theirs); }
  Quat rotation(double x, double y, double z, double w) const;
  double unit_m() const { return unit_m_; }
  Vec3 left() const { return left_; }  // the figure's left, in the generator's coordinates

 private:
  Vec3 left_, up_, forward_;  // our x, y and z in the generator's coordinates
  double handedness_ = 1.0;   // det(B)
  double unit_m_ = 1.0;
};

}  // namespace contort
