// Small symmetric systems, of all sizes that control has and odd ones.
#include "generator/dynamics/linear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/dynamics/states.h"

namespace contort {
namespace {

using Row = std::vector<double>;

Row any_row(std::size_t n, std::mt19937_64& random) {
  Row row(n);
  for (double& v : row) v = fixtures::between(random, -1.0, 1.0);
  return row;
}

// The lower triangle of B B^T + 1/10; the upper one has garbage, which must not be read.
Row any_system(std::size_t n, std::mt19937_64& random) {
  Row matrix(n * n, 1e300);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) matrix[i * n + j] = i == j ? 0.1 : 0.0;
  for (std::size_t k = 0; k < n; ++k) add_square(any_row(n, random), 1.0, matrix);
  return matrix;
}

Row product(const Row& lower, const Row& x) {
  Row out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) out[i] += lower[std::max(i, j) * x.size() + std::min(i, j)] * x[j];
  return out;
}

TEST(Linear, SolvesSymmetricSystemsByTheirLowerTriangle) {
  std::mt19937_64 random(1);
  for (std::size_t n = 0; n <= 25; ++n) {
    const Row system = any_system(n, random), wanted = any_row(n, random);
    Row factors = system, x = wanted;
    factorise_symmetric(factors, static_cast<int>(n));
    solve_factorised(factors, static_cast<int>(n), x);
    const Row got = product(system, x);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-11) << n;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(factors[i * n + j], factors[j * n + i]) << n;
  }
}

// The same row twice: it is satisfied, and all values are finite.
TEST(Linear, DependentRowsStaySmall) {
  Row matrix(4, 0.0), x = {3.0, 3.0};
  add_square(Row{1.0, 1.0}, 2.0, matrix);
  solve_symmetric(matrix, 2, x);
  EXPECT_NEAR(2.0 * (x[0] + x[1]), 3.0, 1e-12);
  EXPECT_LT(std::fabs(x[1]), 1.0);
}

TEST(Linear, AddsScaledRowsOfAnyLengthAndNothingBeyond) {
  for (std::size_t n = 0; n <= 9; ++n) {
    Row sum(n + 1, 0.5), v(n, 2.0);
    add_scaled(0.25, v, std::span(sum).first(n));
    EXPECT_EQ(sum, [&] {
      Row expected(n + 1, 1.0);
      expected[n] = 0.5;
      return expected;
    }());
  }
}

}  // namespace
}  // namespace contort
