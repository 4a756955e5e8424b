#include "generator/dynamics/recursions.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

// Vectors of GCC and Clang, here and below: two of two numbers, which any processor of ours has.
namespace twos {

using Two [[gnu::vector_size(16)]] = double;

struct Vector {
  Two xy, zw;
  double operator[](int k) const { return k < 2 ? xy[k] : zw[k - 2]; }
};

inline Vector load(const WideVec3& v) {
  Vector all;
  std::memcpy(&all, &v, sizeof all);
  return all;
}
inline void store(const Vector& v, WideVec3& out) { std::memcpy(static_cast<void*>(&out), &v, sizeof v); }
inline Vector operator+(const Vector& a, const Vector& b) { return {a.xy + b.xy, a.zw + b.zw}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.xy - b.xy, a.zw - b.zw}; }
inline Vector operator*(const Vector& a, const Vector& b) { return {a.xy * b.xy, a.zw * b.zw}; }
inline Vector operator*(double share, const Vector& v) { return {share * v.xy, share * v.zw}; }
template <int... kWhich>
Two two_of(const Two& a, const Two& b) {
  return __builtin_shufflevector(a, b, kWhich...);
}
inline Vector yzx(const Vector& v) { return {two_of<1, 2>(v.xy, v.zw), two_of<0, 3>(v.xy, v.zw)}; }
inline Vector yxx(const Vector& v) { return {two_of<1, 0>(v.xy, v.xy), two_of<0, 3>(v.xy, v.zw)}; }
inline Vector zzy(const Vector& v) { return {two_of<0, 0>(v.zw, v.zw), two_of<1, 3>(v.xy, v.zw)}; }
inline double dot(const Vector& a, const Vector& b) {
  const Vector products = a * b;
  return products.xy[0] + products.xy[1] + products.zw[0];
}
inline void put_symmetric(const Vector& diagonal, const Vector& beside, WideMat3& out) {
  store({two_of<0, 2>(diagonal.xy, beside.zw), two_of<1, 3>(beside.xy, diagonal.zw)}, out[0]);
  store({two_of<0, 3>(beside.zw, diagonal.xy), two_of<0, 3>(beside.xy, diagonal.zw)}, out[1]);
  store({two_of<1, 0>(beside.xy, beside.xy), diagonal.zw}, out[2]);
}

inline void add_row(double share, const double* row, std::size_t count, double* sum) {
  add_scaled(share, {row, count}, {sum, count});
}

#include "generator/dynamics/recursions.inl"

}  // namespace twos

#ifdef __x86_64__
#include "model/core/avx2_begin.inl"

namespace avx2 {

using Vector [[gnu::vector_size(32)]] = double;

inline Vector load(const WideVec3& v) {
  Vector all;
  std::memcpy(&all, &v, sizeof all);
  return all;
}
inline void store(const Vector& v, WideVec3& out) { std::memcpy(static_cast<void*>(&out), &v, sizeof v); }
inline Vector yzx(const Vector& v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }
inline double dot(const Vector& a, const Vector& b) {
  const Vector products = a * b;
  return products[0] + products[1] + products[2];
}
inline Vector yxx(const Vector& v) { return __builtin_shufflevector(v, v, 1, 0, 0, 3); }
inline Vector zzy(const Vector& v) { return __builtin_shufflevector(v, v, 2, 2, 1, 3); }
inline void put_symmetric(const Vector& diagonal, const Vector& beside, WideMat3& out) {
  store(__builtin_shufflevector(diagonal, beside, 0, 6, 5, 3), out[0]);
  store(__builtin_shufflevector(diagonal, beside, 6, 1, 4, 3), out[1]);
  store(__builtin_shufflevector(diagonal, beside, 5, 4, 2, 3), out[2]);
}

inline void add_row(double share, const double* row, std::size_t count, double* sum) {
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    Vector a, b;
    std::memcpy(&a, row + i, sizeof a);
    std::memcpy(&b, sum + i, sizeof b);
    b += share * a;
    std::memcpy(sum + i, &b, sizeof b);
  }
  for (; i < count; ++i) sum[i] += share * row[i];
}

#include "generator/dynamics/recursions.inl"

}  // namespace avx2

#include "model/core/avx2_end.inl"
#endif

std::vector<RecursionSet> find_sets() {
  std::vector<RecursionSet> found{
      {"any", twos::place_links, twos::sum_forces, twos::fill_mass_matrix, twos::multiply, twos::place_mass}};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2"))
    found.push_back(
        {"AVX2", avx2::place_links, avx2::sum_forces, avx2::fill_mass_matrix, avx2::multiply, avx2::place_mass});
#endif
  return found;
}

}  // namespace

std::span<const RecursionSet> recursion_sets() {
  static const std::vector<RecursionSet> sets = find_sets();
  return sets;
}

}  // namespace contort
