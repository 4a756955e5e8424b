#include "model/motion/foreign.h"

#include <algorithm>

namespace contort {

bool ForeignFacts::may_jump_into(int frame) const { return std::ranges::binary_search(jumps, frame); }

bool ForeignFacts::may_root_jump_into(int frame) const {
  const auto holds = [frame](const FrameSpan& span) { return span.first_frame <= frame && frame <= span.last_frame; };
  return may_jump_into(frame) || std::ranges::any_of(travels, holds);
}

bool ForeignFacts::compares(Equality why) const {
  return std::ranges::any_of(equals, [why](const EqualMotion& other) { return other.why == why; });
}

}  // namespace contort
