// The stage of dynamics: a target motion in, the motion of a figure with mass out. docs/internals/dynamics.md has the
// order of a tick.
#pragma once

#include <functional>

#include "generator/dynamics/foot_contacts.h"
#include "generator/dynamics/impact_response.h"
#include "generator/dynamics/leg_stops.h"
#include "generator/dynamics/loose_motion.h"
#include "generator/dynamics/body_contacts.h"
#include "generator/dynamics/recorder.h"
#include "generator/dynamics/standing.h"
#include "model/spec/dynamics_desc.h"
#include "model/world/environment.h"

namespace contort {

// All constant data of a simulation.
struct DynamicsSetup {
  Mode mode = Mode::kinematic;
  int ticks_per_frame = 1;
  DynamicFigure figure;
  std::vector<TouchPoint> touches;
  std::vector<Impact> impacts;
  std::vector<double> easy;  // easy_accelerations, by joint
};

// Codes dynamics.unknown_name, .bad_load, with pointers from the description's root. `start` rotates impulses.
Result<DynamicsSetup> build_dynamics(const DynamicsDesc& desc, const Character& character, std::span<const Leg> legs,
                                     double rate_hz, const Quat& start);

// Scratch, reused from call to call and setup to setup.
struct SimulationScratch {
  EquationOfMotion equation;
  FootContacts contacts;
  Standing standing;
  LooseMotion loose;
  BodyContacts bodies;
  ImpactResponse impact;
  LegStops leg_stops;
  Recorder record;
  std::vector<double> tracked;          // wanted accelerations of tracking, by degree of freedom
  Actuation actuation;                  // actuation of this tick
  std::vector<double> velocity_before;  // velocities before a trial to stand again
  std::function<void()> after_tick;     // for measurements; mostly empty
};

// Replaces `motion`, which is the target, by the motion of a figure with mass: its poses become the figure's, and its
// response records the events. Cannot fail.
void simulate(const Character& character, const DynamicsSetup& setup, const Environment& environment,
              SimulationScratch& scratch, Motion& motion);

}  // namespace contort
