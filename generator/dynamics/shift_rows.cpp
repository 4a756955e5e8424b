#include "generator/dynamics/shift_rows.h"

#include <vector>

namespace contort {

namespace {

// Takes the unknown shift beside an end out of the end's row, and answers what is added to the row's own share.
double close_end(const ShiftEnd& end, ShiftRow& row) {
  const double kept = 1.0 / (1.0 + end.rate);
  row.ask -= row.spread * (1.0 - kept) * end.rest_m;
  return row.spread * kept;
}

}  // namespace

// Gauss's elimination of a tridiagonal system, down and up again.
void solve_shift(std::span<ShiftRow> rows, const ShiftEnd& before, const ShiftEnd& after, std::span<Vec3> shift_m) {
  std::vector<double> middle;
  for (const ShiftRow& row : rows) middle.push_back(-2.0 * row.spread - row.pressure_N);
  middle.front() += close_end(before, rows.front());
  middle.back() += close_end(after, rows.back());
  for (std::size_t f = 1; f < rows.size(); ++f) {
    const double share = rows[f].spread / middle[f - 1];
    middle[f] -= share * rows[f - 1].spread;
    rows[f].ask -= share * rows[f - 1].ask;
  }
  Vec3 next(0.0);
  for (std::size_t f = rows.size(); f-- > 0;) {
    next = (rows[f].ask - (f + 1 < rows.size() ? rows[f].spread : 0.0) * next) / middle[f];
    shift_m[f] = next;
  }
}

}  // namespace contort
