// Stage: the result of building a valid Spec. Building is the only step that may refuse; generating from a Stage cannot
// fail.
#pragma once

#include <memory>

#include "generator/dynamics/simulate.h"
#include "model/motion/legs.h"
#include "generator/timeline/timeline.h"
#include "model/character/character.h"
#include "model/spec/spec.h"
#include "model/world/environment.h"

namespace contort {

struct Stage {
  std::shared_ptr<const Character> character;
  Timeline timeline;
  Level level;
  std::shared_ptr<const Motion> recorded;  // played instead of the timeline; mostly null
  Environment environment;
  std::vector<Leg> legs;
  std::shared_ptr<const DynamicsSetup> dynamics;  // null: kinematic
  double rate_hz = 60.0;
  Rigid start;          // place of the character in frame 0: a turn about +Y and a translation
  bool bends = false;   // the hips begin in front of or behind the feet, or lower than at rest
  int hold_frames = 0;  // frames after the queue is empty
  int most_frames = 1;  // >= 1; the motion is shorter if an interrupt never fires, or drops the sequence that it cuts
};

// Codes "spec.*", "environment.*", "dynamics.*", "recording.*" and "character.*" with pointers into the spec.
Result<Stage> build_stage(const Spec& spec, const Library& library);

// Builds a stage with a character that was built from spec.character before; many specs can share one.
Result<Stage> build_stage(const Spec& spec, std::shared_ptr<const Character> character,
                          const Library& library = stock_library());

}  // namespace contort
