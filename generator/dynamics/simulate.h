// The stage of dynamics: a target motion in, the motion of a figure with mass out. docs/internals/dynamics.md has the
// order of a tick.
#pragma once

#include <functional>

#include "generator/dynamics/foot_contacts.h"
#include "generator/dynamics/impact_response.h"
#include "generator/dynamics/loose_motion.h"
#include "generator/dynamics/body_contacts.h"
#include "generator/dynamics/recorder.h"
#include "generator/dynamics/standing.h"
#include "model/spec/dynamics_desc.h"
#include "model/world/environment.h"

namespace contort {

// All that does not change while it runs.
struct DynamicsSetup {
  Mode mode = Mode::kinematic;
  int ticks_per_frame = 1;
  DynamicFigure figure;
  std::vector<TouchPoint> touches;
  std::vector<Impact> impacts;
  std::vector<double> easy;  // by joint: easy_accelerations
};

// Codes dynamics.unknown_name, .bad_load, with pointers from the description's root. `start` turns impulses.
Result<DynamicsSetup> build_dynamics(const DynamicsDesc& desc, const Character& character, std::span<const Leg> legs,
                                     double rate_hz, const Quat& start);

// Memory, reused from call to call and setup to setup.
struct SimulationScratch {
  EquationOfMotion equation;
  FootContacts contacts;
  Standing standing;
  LooseMotion loose;
  BodyContacts bodies;
  ImpactResponse impact;
  Recorder record;
  std::vector<double> tracked;          // accelerations that tracking wants, by freedom
  Actuation actuation;                  // of this tick
  std::vector<double> velocity_before;  // of a trial to take hold
  std::function<void()> after_tick;     // for those who measure; mostly empty
};

// Moves `motion`, which is the target, as a figure with mass would: its poses become the figure's, its response tells
// what happened. Cannot fail.
void simulate(const Character& character, const DynamicsSetup& setup, const Environment& environment,
              SimulationScratch& scratch, Motion& motion);

}  // namespace contort
