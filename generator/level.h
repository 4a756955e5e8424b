// Storage levels (seed P11): a stored spec is played whole, or one of its sequences, one of its clips, or one part's
// animation alone.
#pragma once

#include <optional>
#include <string>

#include "generator/stage.h"

namespace contort {

struct Level {
  enum class Kind { whole, sequence, clip, part };
  Kind kind = Kind::whole;
  int sequence = 0;  // counted from 1, as people do; those of interrupts come after the queue's
  int clip = 0;      // the same
  std::string slot;
};

// "sequence:2", "clip:2/1", "part:arm_right". Code level.bad_name.
Result<Level> parse_level(const std::string& text);

// The stage of that level alone. A sequence or a clip begins at frame 0 from the stage's start; a part is moved in the
// frames in which the whole spec moves it, and everything else stays. Codes level.no_sequence, .no_clip, .no_part, and
// those of build_stage.
Result<Stage> build_stage_at(const Spec& spec, const Library& library, const Level& level);

}  // namespace contort
