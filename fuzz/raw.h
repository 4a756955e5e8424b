// A spec as bounded whole numbers, and the functions that read each number as a choice. Every raw spec composes to a
// spec that builds, so drawing, mutating and crossing them needs no repair.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace contort {

inline constexpr int kLattice = 10000;  // every raw number is in [0, kLattice]

inline constexpr std::size_t kRawValues = 24;
inline constexpr std::size_t kRawParts = 16;
inline constexpr std::size_t kRawObjects = 4;
inline constexpr std::size_t kRawGround = 16;
inline constexpr std::size_t kRawDynamics = 24;
inline constexpr std::size_t kLoadCount = 1, kBlowCount = 2;  // positions of two of these numbers: greater values make
                                                              // more loads or blows

struct RawAction {
  int slot = 0;
  int action = 0;
  int start = 0;
  int duration = 0;
  int speed = 0;
  int blend_in = 0;
  int blend_out = 0;
  std::array<int, kRawValues> values{};
  bool operator==(const RawAction&) const = default;
};

struct RawClip {
  int start = 0;
  int speed = 0;
  int stretch = 0;
  std::vector<RawAction> actions;
  bool operator==(const RawClip&) const = default;
};

struct RawInterrupt {
  int event = 0;
  int what = 0;  // the event's parameter: a frame, a clip or a sequence
  int enter = 0;
  int after = 0;
  int resume = 0;
  std::vector<RawClip> clips;
  bool operator==(const RawInterrupt&) const = default;
};

struct RawSpec {
  int character = 0;
  int hold = 0;
  int interrupted = 0;
  int obstacle = 0;
  int omitted = 0;  // if not 0, half of all features are left out, chosen by this number (features.h)
  std::array<int, kRawGround> ground{};
  std::array<int, kRawParts> parts{};
  std::array<int, kRawObjects> objects{};
  std::array<int, kRawDynamics> dynamics{};
  std::vector<std::vector<RawClip>> sequences;
  std::vector<RawInterrupt> interrupts;
  bool operator==(const RawSpec&) const = default;
};

inline double fraction(int raw) { return static_cast<double>(raw) / kLattice; }

// Returns an index below `count`; raw = kLattice gives the last one, not one past it.
inline std::size_t pick(int raw, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(raw) * count / (kLattice + 1));
}

// Returns a whole number from low to high.
inline int between(int raw, int low, int high) {
  return low + static_cast<int>(pick(raw, static_cast<std::size_t>(high - low + 1)));
}

// Returns true for this fraction of all raw numbers: reads the number as a decision with these odds.
inline bool happens(int raw, double odds) { return raw < odds * kLattice; }

}  // namespace contort
