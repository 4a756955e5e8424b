// A figure that follows a target: its state, and the wanted accelerations of tracking control.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "generator/dynamics/target.h"

namespace contort {

struct FigureState {
  Rigid root;
  std::vector<double> coords;    // a pose row
  std::vector<double> velocity;  // see Multibody
};

// A figure that takes a target's accelerations tick by tick, on it from the start, does not go along its cubics:
// accelerations are blended evenly between frames. Its poses differ by this share of a frame's second difference.
double missed_of_bend(int ticks_per_frame);

// The target's pose at frame 0, and its rates half a tick before, as for a figure that advance() has moved there.
FigureState moving_start(const Multibody& body, const TargetMotion& target, double tick_s = 0.0);

struct Tracking {
  bool root_leads =
      false;  // the root follows its own path closely, and legs follow it; otherwise it is tracked like joints
  // The time since a recent impact, s; empty without one. After an impact, the stiffness of the root is limited,
  // because the ground cannot move the root faster.
  std::optional<double> since_impact_s{};
  bool exactly = false;  // joints: with a correction of the cubics, so that a figure on the target stays on it exactly
};

// A joint of the target as a figure reaches it that applies the target's accelerations tick by tick.
struct TargetLead {
  double frame = -1.0;
  double coords[4]{};
  Vec3 acceleration{0.0};
};

// The joints of a target relative to a figure that follows it, by degree of freedom; not set for the root.
struct TargetAhead {
  std::vector<double> way;  // from the figure's joint to the target's, rad or m
  std::vector<double> velocity;
  std::vector<double> acceleration;
};

struct TrackScratch {
  // Results of the last tick, by joint and three travels of the root. They save half of the work in the next one.
  std::vector<TargetLead> leads;
  TargetAhead ahead;  // a result of track()
};

// The accelerations of all degrees of freedom at a time in frames, each joint separately; tick_s is the time until the
// next call. The scratch must belong to the same target.
void track(const Multibody& body, const TargetMotion& target, double frame, double tick_s, const Tracking& how,
           const FigureState& state, TrackScratch& scratch, std::span<double> acceleration);

// Semi-implicit Euler: advances velocities first, then poses with the new velocities.
void advance(const Multibody& body, std::span<const double> acceleration, double tick_s, FigureState& state);

}  // namespace contort
