// Small dense linear algebra for control: symmetric systems of a few unknowns, in place, in a fixed order.
#pragma once

#include <cstring>
#include <span>

namespace contort {

// A = L D L^T of a symmetric positive matrix of n rows. Only its lower triangle is read; it is overwritten by D, with L
// below it and L^T above it. Pivots below 1e-12 of the largest diagonal entry are replaced by that value, so that
// results for dependent rows stay small.
void factorise_symmetric(std::span<double> matrix, int n);

// Solves A x = b, x in place of b.
void solve_factorised(std::span<const double> factors, int n, std::span<double> x);

// Factorises and solves.
void solve_symmetric(std::span<double> matrix, int n, std::span<double> x);

// Adds weight * v v^T to the lower triangle of A.
void add_square(std::span<const double> v, double weight, std::span<double> matrix);

double dot(std::span<const double> a, std::span<const double> b);

// sum += share * v, without overlap. It is written for two numbers at a time, because a compiler that vectorises it
// first checks for overlap, which takes as long as a dozen numbers.
inline void add_scaled(double share, std::span<const double> v, std::span<double> sum) {
  using Two [[gnu::vector_size(16)]] = double;
  std::size_t i = 0;
  for (; i + 2 <= v.size(); i += 2) {
    Two a, b;
    std::memcpy(&a, &v[i], sizeof a);
    std::memcpy(&b, &sum[i], sizeof b);
    b += share * a;
    std::memcpy(&sum[i], &b, sizeof b);
  }
  if (i < v.size()) sum[i] += share * v[i];
}

}  // namespace contort
