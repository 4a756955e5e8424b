// The scope of a stored spec that is replayed: the whole, one of its sequences, one of its clips, or the animation of
// one part.
#pragma once

#include <string>

#include "model/core/result.h"
#include "model/spec/spec.h"

namespace contort {

struct ReplayScope {
  enum class Kind { whole, sequence, clip, part };
  Kind kind = Kind::whole;
  int sequence = 0;  // counted from 1; sequences of interrupts come after those of the queue
  int clip = 0;      // counted from 1, too
  std::string slot;
  bool operator==(const ReplayScope&) const = default;
};

// Parses a scope such as "sequence:2", "clip:2/1" or "part:arm_right". Code level.bad_name.
Result<ReplayScope> parse_scope(const std::string& text);

// The spec of that scope. A sequence or a clip begins from the state that the earlier ones have left. A part moves in
// the frames in which the whole spec moves it, and everything else stands still.
Spec scoped(Spec spec, const ReplayScope& scope);

}  // namespace contort
