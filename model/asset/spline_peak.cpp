#include "model/asset/spline_peak.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace contort {

namespace {

constexpr double kTolerance = 1.01;   // greatest ratio of the true peak to the result
constexpr double kStill_rad = 1e-6;   // slower rotations count as none
constexpr int kMostPieces = 512;      // splines of real files take about ten
constexpr double kNoLength = 1e-24;   // squared length of a quaternion that is no rotation

// A polynomial on [0, 1] by Bernstein's coefficients.
template <std::size_t Degree>
using Bernstein = std::array<double, Degree + 1>;

constexpr double choose(std::size_t n, std::size_t k) {
  double out = 1.0;
  for (std::size_t i = 1; i <= k; ++i) out = out * static_cast<double>(n - k + i) / static_cast<double>(i);
  return out;
}

// The weights of products of coefficients in the product of two polynomials.
template <std::size_t N, std::size_t M>
constexpr std::array<std::array<double, M>, N> weights() {
  std::array<std::array<double, M>, N> out{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < M; ++j)
      out[i][j] = choose(N - 1, i) * choose(M - 1, j) / choose(N + M - 2, i + j);
  return out;
}

template <std::size_t N, std::size_t M>
std::array<double, N + M - 1> times(const std::array<double, N>& a, const std::array<double, M>& b) {
  static constexpr auto kWeights = weights<N, M>();
  std::array<double, N + M - 1> out{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < M; ++j) out[i + j] += kWeights[i][j] * a[i] * b[j];
  return out;
}

// De Casteljau's algorithm: splits a polynomial into its halves.
template <std::size_t N>
std::pair<std::array<double, N>, std::array<double, N>> halves(std::array<double, N> p) {
  std::pair<std::array<double, N>, std::array<double, N>> out;
  for (std::size_t level = 0; level < N; ++level) {
    out.first[level] = p[0];
    out.second[N - 1 - level] = p[N - 1 - level];
    for (std::size_t i = 0; i + 1 < N - level; ++i) p[i] = 0.5 * (p[i] + p[i + 1]);
  }
  return out;
}

// A part of the interval, with bounds of |q ^ q'|^2 and |q|^2 on it.
struct Piece {
  double from = 0.0;
  double to = 1.0;
  Bernstein<10> turn_squared{};
  Bernstein<6> length_squared{};

  double bound_rad() const {
    const double most = std::ranges::max(turn_squared), least = std::ranges::min(length_squared);
    if (!(most > 0.0)) return 0.0;
    return least > kNoLength ? 2.0 * std::sqrt(most) / least : std::numeric_limits<double>::infinity();
  }
  static double speed_rad(double turn_squared, double length_squared) {
    return length_squared > kNoLength ? 2.0 * std::sqrt(std::max(turn_squared, 0.0)) / length_squared : 0.0;
  }
};

Piece whole(const BezierTurn& spline) {
  std::array<Bernstein<3>, 4> q{};
  std::array<Bernstein<2>, 4> dq{};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < 4; ++i) q[c][i] = spline[i][c];
    for (std::size_t i = 0; i < 3; ++i) dq[c][i] = 3.0 * (spline[i + 1][c] - spline[i][c]);
  }
  Piece out;
  for (std::size_t a = 0; a < 4; ++a) {
    const Bernstein<6> square = times(q[a], q[a]);
    for (std::size_t i = 0; i < square.size(); ++i) out.length_squared[i] += square[i];
    for (std::size_t b = a + 1; b < 4; ++b) {
      const Bernstein<5> one = times(q[a], dq[b]), other = times(q[b], dq[a]);
      Bernstein<5> outer{};
      for (std::size_t i = 0; i < outer.size(); ++i) outer[i] = one[i] - other[i];
      const Bernstein<10> outer_squared = times(outer, outer);
      for (std::size_t i = 0; i < outer_squared.size(); ++i) out.turn_squared[i] += outer_squared[i];
    }
  }
  return out;
}

void look_at(const Piece& piece, SplinePeak& best) {
  const double first = Piece::speed_rad(piece.turn_squared.front(), piece.length_squared.front());
  const double last = Piece::speed_rad(piece.turn_squared.back(), piece.length_squared.back());
  if (first > best.turn_rad) best = {piece.from, first};
  if (last > best.turn_rad) best = {piece.to, last};
}

}  // namespace

SplinePeak fastest_turn(const BezierTurn& spline, double most_rad) {
  SplinePeak best;
  std::vector<Piece> open = {whole(spline)};
  look_at(open.back(), best);
  for (int looked_at = 0; !open.empty() && looked_at < kMostPieces && best.turn_rad < most_rad; ++looked_at) {
    const Piece piece = open.back();
    open.pop_back();
    if (piece.bound_rad() <= std::max(kTolerance * best.turn_rad, kStill_rad)) continue;
    const double middle = 0.5 * (piece.from + piece.to);
    const auto turns = halves(piece.turn_squared);
    const auto lengths = halves(piece.length_squared);
    const Piece left{piece.from, middle, turns.first, lengths.first};
    const Piece right{middle, piece.to, turns.second, lengths.second};
    look_at(left, best);
    const bool left_is_faster = left.bound_rad() > right.bound_rad();
    open.push_back(left_is_faster ? right : left);
    open.push_back(left_is_faster ? left : right);
  }
  return best;
}

}  // namespace contort
