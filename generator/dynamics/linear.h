// Small dense linear algebra for control: symmetric systems of a few unknowns, in place, in a fixed order.
#pragma once

#include <span>

namespace contort {

// A = L D L^T of a symmetric positive matrix of n rows (its lower triangle; overwritten by the factors). Pivots below
// 1e-12 of the largest diagonal entry are taken as that: what depends on other rows stays small.
void factorise_symmetric(std::span<double> matrix, int n);

// Solves A x = b, x in place of b.
void solve_factorised(std::span<const double> factors, int n, std::span<double> x);

// Both.
void solve_symmetric(std::span<double> matrix, int n, std::span<double> x);

// The lower triangle of A += weight * v v^T.
void add_square(std::span<const double> v, double weight, std::span<double> matrix);

double dot(std::span<const double> a, std::span<const double> b);

}  // namespace contort
