#include "model/motion/foreign.h"

#include <algorithm>

namespace contort {

bool ForeignFacts::may_jump_into(int frame) const { return std::ranges::binary_search(jumps, frame); }

bool ForeignFacts::compares(Equality why) const {
  return std::ranges::any_of(equals, [why](const EqualMotion& other) { return other.why == why; });
}

}  // namespace contort
