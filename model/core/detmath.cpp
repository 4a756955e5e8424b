// Range reduction plus Taylor polynomials. On the reduced ranges the first term left out is below 1e-18, so the error
// is that of the last few roundings. Textbook methods (Muller, Elementary Functions, ch. 9 and 11); constants computed
// with 60 decimal digits.
#include "model/core/detmath.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace contort::det {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalfPi = 0x1.921fb54442d18p+0;
constexpr double kHalfPiTail = 0x1.1a62633145c07p-54;
constexpr double kTwoOverPi = 0.63661977236758134308;

// pi/2 = kPio2A + kPio2B + kPio2C. The first two have 33 significant bits, so k * them is exact for |k| < 2^20.
constexpr double kPio2A = 0x1.921fb54400000p+0;
constexpr double kPio2B = 0x1.0b4611a600000p-34;
constexpr double kPio2C = 0x1.3198a2e037073p-69;

constexpr double kLn2High = 0x1.62e42fef00000p-1;
constexpr double kLn2Low = 0x1.473de6af278edp-34;
constexpr double kOneOverLn2 = 1.44269504088896340736;

// atan(i / 8) for i = 0..8.
constexpr std::array<double, 9> kAtanEighths = {0.0,
                                                0x1.fd5ba9aac2f6ep-4,
                                                0x1.f5b75f92c80ddp-3,
                                                0x1.6f61941e4def1p-2,
                                                0x1.dac670561bb4fp-2,
                                                0x1.1e00babdefeb4p-1,
                                                0x1.4978fa3269ee1p-1,
                                                0x1.700a7c5784634p-1,
                                                0x1.921fb54442d18p-1};

constexpr double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

// A pair of sine and cosine, which are computed at once because a register has room for two.
constexpr SinCos operator+(const SinCos& a, const SinCos& b) { return {a.sin + b.sin, a.cos + b.cos}; }
constexpr SinCos operator*(const SinCos& a, double x) { return {a.sin * x, a.cos * x}; }

// c[0] + c[1] x + c[2] x^2 + …, by Estrin's scheme: neighbours are joined in pairs, then the pairs in x^2. It has half
// as many dependent operations as Horner's scheme at every step, and these take the time here.
template <class Value, std::size_t N>
Value polynomial(double x, const std::array<Value, N>& c) {
  if constexpr (N == 1) {
    return c[0];
  } else {
    std::array<Value, (N + 1) / 2> pairs;
    for (std::size_t i = 0; i < N / 2; ++i) pairs[i] = c[2 * i] + c[2 * i + 1] * x;
    if constexpr (N % 2 == 1) pairs[N / 2] = c[N - 1];
    return polynomial(x * x, pairs);
  }
}

// sin r = r + r^3 * poly(r^2), cos r = 1 - r^2/2 + r^4 * poly(r^2), |r| <= pi/4
constexpr std::array<SinCos, 8> kSinCos = [] {
  std::array<SinCos, 8> c{};
  for (int i = 0; i < 8; ++i) {
    const double sign = i % 2 == 0 ? -1.0 : 1.0;
    c[static_cast<std::size_t>(i)] = {sign / factorial(2 * i + 3), -sign / factorial(2 * i + 4)};
  }
  return c;
}();
constexpr std::array<double, 7> kAtan = [] {  // atan r = r + r^3 * poly(r^2), |r| <= 1/16
  std::array<double, 7> c{};
  for (int i = 0; i < 7; ++i) c[static_cast<std::size_t>(i)] = (i % 2 == 0 ? -1.0 : 1.0) / (2 * i + 3);
  return c;
}();
constexpr std::array<double, 12> kExp = [] {  // exp r = 1 + r + r^2 * poly(r), |r| <= ln2/2
  std::array<double, 12> c{};
  for (int i = 0; i < 12; ++i) c[static_cast<std::size_t>(i)] = 1.0 / factorial(i + 2);
  return c;
}();

double atan_unit(double t) {  // t in [0, 1]
  const int nearest = static_cast<int>(t * 8.0 + 0.5);
  const double c = nearest / 8.0;
  const double r = (t - c) / (1.0 + t * c);
  return kAtanEighths[static_cast<std::size_t>(nearest)] + (r + r * r * r * polynomial(r * r, kAtan));
}

double power_of_two(int k) { return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52); }

}  // namespace

SinCos sincos(double x_rad) {
  if (!(std::fabs(x_rad) <= 1e9)) return {kNaN, kNaN};
  const double k = std::floor(x_rad * kTwoOverPi + 0.5);
  // r + tail is the reduced angle; the tail repairs the rounding of the last subtraction.
  const double high = (x_rad - k * kPio2A) - k * kPio2B;
  const double low = k * kPio2C;
  const double r = high - low;
  const double tail = (high - r) - low;
  const double r2 = r * r;
  const SinCos sum = polynomial(r2, kSinCos);
  const double s = r + (r * r2 * sum.sin + tail * (1.0 - 0.5 * r2));
  const double half_r2 = 0.5 * r2;
  const double w = 1.0 - half_r2;
  const double c = w + (((1.0 - w) - half_r2) + (r2 * r2 * sum.cos - r * tail));
  // Selects by quarter turns (s, c), (c, -s), (-s, -c), (-c, s) with bit operations, because processors cannot predict
  // branches on angles.
  const auto quarter = static_cast<std::uint64_t>(static_cast<std::int64_t>(k));
  const auto s_bits = std::bit_cast<std::uint64_t>(s), c_bits = std::bit_cast<std::uint64_t>(c);
  const std::uint64_t exchange = (quarter & 1) != 0 ? s_bits ^ c_bits : 0;
  return {std::bit_cast<double>(s_bits ^ exchange ^ (quarter & 2) << 62),
          std::bit_cast<double>(c_bits ^ exchange ^ ((quarter + 1) & 2) << 62)};
}

namespace {

// Vector types of GCC and Clang: two numbers fit into one register of every supported processor.
namespace twos {

using Lanes [[gnu::vector_size(16)]] = double;
using LaneBits [[gnu::vector_size(16)]] = std::int64_t;

#include "model/core/sincos_lanes.inl"

}  // namespace twos

#ifdef __x86_64__
#include "model/core/avx2_begin.inl"

namespace avx2 {

using Lanes [[gnu::vector_size(32)]] = double;
using LaneBits [[gnu::vector_size(32)]] = std::int64_t;

#include "model/core/sincos_lanes.inl"

}  // namespace avx2

#include "model/core/avx2_end.inl"
#endif

bool are_usual(std::span<const double> x_rad) {
  for (const double x : x_rad)
    if (!(std::fabs(x) <= 1e9)) return false;
  return true;
}

#ifdef __x86_64__
// Computes at most four angles; the missing ones of four are 0.
void sincos_of_few(std::span<const double> x_rad, std::span<SinCos> out) {
  std::array<double, avx2::kLanes> all_rad{};
  std::array<SinCos, avx2::kLanes> all;
  for (std::size_t i = 0; i < x_rad.size(); ++i) all_rad[i] = x_rad[i];
  avx2::sincos_of_lanes(all_rad.data(), all.data());
  for (std::size_t i = 0; i < x_rad.size(); ++i) out[i] = all[i];
}
#endif

}  // namespace

void sincos(std::span<const double> x_rad, std::span<SinCos> out) {
  std::size_t i = 0;
  const bool usual = are_usual(x_rad);
#ifdef __x86_64__
  if (usual && x_rad.size() > twos::kLanes && __builtin_cpu_supports("avx2")) {
    for (; i + avx2::kLanes <= x_rad.size(); i += avx2::kLanes) avx2::sincos_of_lanes(&x_rad[i], &out[i]);
    if (i + twos::kLanes < x_rad.size()) return sincos_of_few(x_rad.subspan(i), out.subspan(i));
  }
#endif
  for (; usual && i + twos::kLanes <= x_rad.size(); i += twos::kLanes) twos::sincos_of_lanes(&x_rad[i], &out[i]);
  for (; i < x_rad.size(); ++i) out[i] = sincos(x_rad[i]);
}

double sin(double x_rad) { return sincos(x_rad).sin; }
double cos(double x_rad) { return sincos(x_rad).cos; }

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNaN;
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  if (ay == 0.0 && (x >= 0.0 || ax == 0.0)) return 0.0;  // common case: the angle between equal rotations
  const bool steep = ay > ax;
  double angle = 0.0;
  if (ax == kInfinity && ay == kInfinity) {
    angle = 0.5 * kHalfPi;
  } else {
    angle = atan_unit(steep ? ax / ay : ay / ax);
    // The tail is added to the smaller number, where it is not rounded off.
    if (steep) angle = kHalfPi - (angle - kHalfPiTail);
  }
  if (x < 0.0) angle = 2.0 * kHalfPi - (angle - 2.0 * kHalfPiTail);
  return y < 0.0 ? -angle : angle;
}

double acos(double x) {
  if (std::isnan(x)) return kNaN;
  const double c = x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x;
  return 2.0 * atan2(std::sqrt(1.0 - c), std::sqrt(1.0 + c));
}

double asin(double x) {
  if (std::isnan(x)) return kNaN;
  const double s = x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x;
  return atan2(s, std::sqrt((1.0 - s) * (1.0 + s)));
}

double exp(double x) {
  if (std::isnan(x)) return kNaN;
  if (x > 709.782712893384) return kInfinity;
  if (x < -745.2) return 0.0;
  const double k = std::floor(x * kOneOverLn2 + 0.5);
  const double r = (x - k * kLn2High) - k * kLn2Low;
  const double value = 1.0 + (r + r * r * polynomial(r, kExp));
  // In two steps, so that no factor over- or underflows if the result does not.
  const int half = static_cast<int>(k) / 2;
  return value * power_of_two(half) * power_of_two(static_cast<int>(k) - half);
}

}  // namespace contort::det
