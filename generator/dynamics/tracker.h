// A figure that follows a target: its state, and the accelerations that tracking control asks for.
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/target.h"

namespace contort {

struct FigureState {
  Rigid root;
  std::vector<double> coords;    // a pose row
  std::vector<double> velocity;  // see Multibody
};

// The target's pose and rates at frame 0.
FigureState moving_start(const Multibody& body, const TargetMotion& target);

struct Tracking {
  bool root_leads =
      false;             // the root follows its own way closely and legs come along; else it is tracked as joints are
  bool exactly = false;  // joints: with what the cubics miss of the target, so that a figure on it stays on it
};

// The accelerations of all freedoms at a time in frames, each joint by itself; tick_s is the time until the next call.
void track(const Multibody& body, const TargetMotion& target, double frame, double tick_s, const Tracking& how,
           const FigureState& state, std::span<double> acceleration);

// Semi-implicit Euler: velocities first, then poses with them.
void advance(const Multibody& body, std::span<const double> acceleration, double tick_s, FigureState& state);

}  // namespace contort
