// Random numbers for changes to drawn cases: SplitMix64 (Steele, Lea and Flood, OOPSLA 2014), a counter behind a mixing
// function, so that keying one for every case costs nothing.
#pragma once

#include <cstdint>

#include "fuzz/raw.h"

namespace contort {

class Dice {
 public:
  // Equal keys give equal throws, everywhere.
  Dice(std::int64_t seed, std::int64_t index, std::uint64_t stream)
      : state_(mixed(mixed(mixed(static_cast<std::uint64_t>(seed)) + static_cast<std::uint64_t>(index)) + stream)) {}

  std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15ULL); }
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  int raw() { return below(kLattice + 1); }
  bool one_in(int count) { return below(count) == 0; }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace contort
