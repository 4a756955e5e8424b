// The strength of a blow over time.
#pragma once

namespace contort {

// u (1 - u)^3, scaled to 1 at its maximum, u = 1/4. It rises at once and settles: 0 at both ends, without slope at u =
// 1.
inline double pulse(double u) {
  const double left = 1.0 - u;
  return 256.0 / 27.0 * u * left * left * left;
}

}  // namespace contort
