// Stage: what a valid Spec builds. Building is the only step that may refuse; generating from a Stage cannot fail.
#pragma once

#include <memory>

#include "generator/character/character.h"
#include "generator/spec.h"
#include "generator/timeline/timeline.h"

namespace contort {

struct Stage {
  std::shared_ptr<const Character> character;
  Timeline timeline;
  double rate_hz = 60.0;
  int frame_count = 1;  // >= 1
};

// Codes "spec.*" and "character.*" with pointers into the spec.
Result<Stage> build_stage(const Spec& spec, const Library& library);

// The same with a character that was built from spec.character before; many specs can share one.
Result<Stage> build_stage(const Spec& spec, std::shared_ptr<const Character> character);

}  // namespace contort
