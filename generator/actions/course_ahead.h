// The next frames of a course of legs, for actions that move the legs' carriers.
#pragma once

#include <array>

#include "generator/actions/action.h"

namespace contort {

struct FramesAhead {
  // The present frame, those of the next cycle of a gait or the lowest point of a bend, and the standing pose.
  std::array<GaitFrame, 16> frames;
  bool is_bend = false;  // heels of standing feet may rise; in a gait, they rise as the gait says
};
FramesAhead frames_ahead(const WholeBody& course);

}  // namespace contort
