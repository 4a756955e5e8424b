// The stage of dynamics: a target motion in, the motion of a figure with mass out. docs/dynamics.md has the order of a
// tick.
#pragma once

#include <functional>

#include "generator/dynamics/control.h"
#include "generator/dynamics/feet.h"
#include "generator/dynamics/impact.h"
#include "generator/dynamics/loose.h"
#include "generator/dynamics/recorder.h"
#include "generator/dynamics/target.h"
#include "generator/dynamics/tracker.h"
#include "model/spec/dynamics_desc.h"
#include "model/world/environment.h"

namespace contort {

// All that does not change while it runs.
struct DynamicsSetup {
  Mode mode = Mode::kinematic;
  int ticks_per_frame = 1;
  DynamicFigure figure;
  std::vector<TouchPoint> touches;
  std::vector<Blow> blows;
};

// Codes dynamics.unknown_name, .bad_load, with pointers from the description's root. `start` turns impulses.
Result<DynamicsSetup> build_dynamics(const DynamicsDesc& desc, const Character& character, std::span<const Leg> legs,
                                     double rate_hz, const Quat& start);

// Memory, reused from call to call and setup to setup.
struct SimulationScratch {
  DynamicsScratch dynamics;
  SupportRows support;
  SupportArea area;
  GroundShare ground;
  DynamicControl control;
  LooseScratch loose;
  ResponseScratch response;
  FigureState state;
  Feet feet;
  Recorder record;
  std::function<void()> after_tick;  // for those who measure; mostly empty
  std::vector<double> firmness;      // by sole
  std::vector<double> tracked, acceleration, forces, bias, efforts, ease, hold, hold_forces, hold_efforts, mass,
      factors;
};

// Moves `motion`, which is the target, as a figure with mass would: its poses become the figure's, its response tells
// what happened. Cannot fail.
void simulate(const Character& character, const DynamicsSetup& setup, const Environment& environment,
              SimulationScratch& scratch, Motion& motion);

}  // namespace contort
