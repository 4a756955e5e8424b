#include "generator/dynamics/linear.h"

#include <algorithm>

namespace contort {

void factorise_symmetric(std::span<double> matrix, int count) {
  const auto n = static_cast<std::size_t>(count);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, matrix[i * n + i]);
  const double least = std::max(1e-12 * largest, 1e-300);
  for (std::size_t k = 0; k < n; ++k) {
    const std::span<double> right = matrix.subspan(k * n + k + 1, n - k - 1);  // of the pivot: its column, as a row
    for (std::size_t i = 0; i < right.size(); ++i) right[i] = matrix[(k + 1 + i) * n + k];
    const double pivot = matrix[k * n + k] = std::max(matrix[k * n + k], least);
    for (std::size_t i = 0; i < right.size(); ++i) {
      double* row = &matrix[(k + 1 + i) * n + k];
      row[0] = right[i] / pivot;
      add_scaled(-row[0], right.first(i + 1), {row + 1, i + 1});
    }
    for (std::size_t i = 0; i < right.size(); ++i) right[i] = matrix[(k + 1 + i) * n + k];
  }
}

void solve_factorised(std::span<const double> factors, int count, std::span<double> x) {
  const auto n = static_cast<std::size_t>(count);
  for (std::size_t k = 0; k < n; ++k) add_scaled(-x[k], factors.subspan(k * n + k + 1, n - k - 1), x.subspan(k + 1));
  for (std::size_t i = 0; i < n; ++i) x[i] /= factors[i * n + i];
  for (std::size_t k = n; k-- > 0;) add_scaled(-x[k], factors.subspan(k * n, k), x.first(k));
}

void solve_symmetric(std::span<double> matrix, int n, std::span<double> x) {
  factorise_symmetric(matrix, n);
  solve_factorised(matrix, n, x);
}

void add_square(std::span<const double> v, double weight, std::span<double> matrix) {
  const auto is_zero = [](double entry) { return entry == 0.0; };
  const auto first = static_cast<std::size_t>(std::ranges::find_if_not(v, is_zero) - v.begin());
  for (std::size_t i = first; i < v.size(); ++i)
    if (const double scaled = weight * v[i]; scaled != 0.0)
      add_scaled(scaled, v.subspan(first, i + 1 - first), matrix.subspan(i * v.size() + first, i + 1 - first));
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace contort
