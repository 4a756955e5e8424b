// From raw numbers to a spec that builds.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fuzz/compose_dynamics.h"
#include "fuzz/raw.h"
#include "generator/character/library.h"
#include "generator/spec.h"

namespace contort {

inline constexpr std::size_t kRawValues = 24;
inline constexpr std::size_t kRawParts = 16;
inline constexpr std::size_t kRawObjects = 4;

struct RawAction {
  int slot = 0;
  int action = 0;
  int start = 0;
  int duration = 0;
  int speed = 0;
  int blend_in = 0;
  int blend_out = 0;
  std::array<int, kRawValues> values{};
};

struct RawClip {
  int start = 0;
  int speed = 0;
  int stretch = 0;
  std::vector<RawAction> actions;
};

struct RawInterrupt {
  int event = 0;
  int what = 0;  // the frame, the clip, the sequence
  int enter = 0;
  int after = 0;
  int resume = 0;
  std::vector<RawClip> clips;
};

inline constexpr std::size_t kRawGround = 16;

struct RawSpec {
  int character = 0;
  int hold = 0;
  int interrupted = 0;
  int obstacle = 0;
  std::array<int, kRawGround> ground{};
  std::array<int, kRawParts> parts{};
  std::array<int, kRawObjects> objects{};
  std::array<int, kRawDynamics> dynamics{};
  std::vector<std::vector<RawClip>> sequences;
  std::vector<RawInterrupt> interrupts;
};

// Every number is read as a choice among what there is, so every raw value makes a spec that builds.
Spec compose(const RawSpec& raw, const std::vector<std::string>& characters, const Library& library);

}  // namespace contort
