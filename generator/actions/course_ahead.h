// The next frames of a course of legs, for actions that move the legs' carriers.
#pragma once

#include <array>

#include "generator/actions/action.h"

namespace contort {

// The present frame, the frames of the next cycle of a gait or the lowest point of a bend, and the standing pose.
using FramesAhead = std::array<GaitFrame, 16>;
FramesAhead frames_ahead(const WholeBody& course);

}  // namespace contort
