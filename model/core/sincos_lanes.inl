// Sines and cosines of several angles at once, for one type of `Lanes` (see detmath.cpp, which includes this for each).
// The steps are those of sincos(double) in their order, so that the bits are the same.

inline constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(double);
inline constexpr double kRounds = 0x1.8p52;  // a sum with it has no digits behind the point, and that integer's bits

// The largest integers that are not above x, |x| < 2^51.
inline Lanes floor_of(const Lanes& x) {
  const Lanes nearest = (x + kRounds) - kRounds;
  return nearest > x ? nearest - 1.0 : nearest;
}

// One of the polynomials of kSinCos, its terms joined as polynomial() joins them.
template <double SinCos::*kOf>
inline Lanes sum_of(const Lanes& r2, const Lanes& r4) {
  const auto& c = kSinCos;
  return ((c[0].*kOf + c[1].*kOf * r2) + (c[2].*kOf + c[3].*kOf * r2) * r4) +
         ((c[4].*kOf + c[5].*kOf * r2) + (c[6].*kOf + c[7].*kOf * r2) * r4) * (r4 * r4);
}

// Computes sines and cosines of angles within 1e9.
inline void sincos_of_lanes(const double* x_rad, SinCos* out) {
  Lanes x;
  __builtin_memcpy(&x, x_rad, sizeof x);
  const Lanes k = floor_of(x * kTwoOverPi + 0.5);
  const Lanes high = (x - k * kPio2A) - k * kPio2B;
  const Lanes low = k * kPio2C;
  const Lanes r = high - low;
  const Lanes tail = (high - r) - low;
  const Lanes r2 = r * r, r4 = r2 * r2;
  const Lanes half_r2 = 0.5 * r2;
  const Lanes w = 1.0 - half_r2;
  const Lanes s = r + (r * r2 * sum_of<&SinCos::sin>(r2, r4) + tail * w);
  const Lanes c = w + (((1.0 - w) - half_r2) + (r4 * sum_of<&SinCos::cos>(r2, r4) - r * tail));
  const LaneBits quarter = reinterpret_cast<LaneBits>(k + kRounds);
  const LaneBits s_bits = reinterpret_cast<LaneBits>(s), c_bits = reinterpret_cast<LaneBits>(c);
  const LaneBits exchange = (s_bits ^ c_bits) & -(quarter & 1);
  const Lanes sines = reinterpret_cast<Lanes>(s_bits ^ exchange ^ (quarter & 2) << 62);
  const Lanes cosines = reinterpret_cast<Lanes>(c_bits ^ exchange ^ ((quarter + 1) & 2) << 62);
  for (std::size_t lane = 0; lane < kLanes; ++lane) out[lane] = {sines[lane], cosines[lane]};
}
