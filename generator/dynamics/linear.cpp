#include "generator/dynamics/linear.h"

#include <algorithm>

namespace contort {

void factorise_symmetric(std::span<double> matrix, int count) {
  const auto n = static_cast<std::size_t>(count);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, matrix[i * n + i]);
  const double least = std::max(1e-12 * largest, 1e-300);
  for (std::size_t k = 0; k < n; ++k) {
    double& pivot = matrix[k * n + k];
    pivot = std::max(pivot, least);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double share = matrix[i * n + k] / pivot;
      for (std::size_t j = k + 1; j <= i; ++j) matrix[i * n + j] -= share * matrix[j * n + k];
    }
    for (std::size_t i = k + 1; i < n; ++i) matrix[i * n + k] /= pivot;
  }
}

void solve_factorised(std::span<const double> factors, int count, std::span<double> x) {
  const auto n = static_cast<std::size_t>(count);
  for (std::size_t i = 1; i < n; ++i) x[i] -= dot(factors.subspan(i * n, i), x.first(i));
  for (std::size_t i = 0; i < n; ++i) x[i] /= factors[i * n + i];
  for (std::size_t k = n; k-- > 0;)
    for (std::size_t i = k + 1; i < n; ++i) x[k] -= factors[i * n + k] * x[i];
}

void solve_symmetric(std::span<double> matrix, int n, std::span<double> x) {
  factorise_symmetric(matrix, n);
  solve_factorised(matrix, n, x);
}

void add_square(std::span<const double> v, double weight, std::span<double> matrix) {
  const auto is_zero = [](double entry) { return entry == 0.0; };
  const auto first = static_cast<std::size_t>(std::ranges::find_if_not(v, is_zero) - v.begin());
  for (std::size_t i = first; i < v.size(); ++i) {
    const double scaled = weight * v[i];
    if (scaled == 0.0) continue;
    double* row = &matrix[i * v.size()];
    for (std::size_t j = first; j <= i; ++j) row[j] += scaled * v[j];
  }
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace contort
