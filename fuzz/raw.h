// Raw numbers, and how they are read as choices.
#pragma once

#include <algorithm>
#include <cstddef>

namespace contort {

inline constexpr int kLattice = 10000;  // every raw number is in [0, kLattice]

inline double fraction(int raw) { return static_cast<double>(raw) / kLattice; }

// One of `count`; raw = kLattice is the last one, not one past it.
inline std::size_t pick(int raw, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(raw) * count / (kLattice + 1));
}

// Whole numbers from low to high.
inline int between(int raw, int low, int high) {
  return low + static_cast<int>(pick(raw, static_cast<std::size_t>(high - low + 1)));
}

}  // namespace contort
