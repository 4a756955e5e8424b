// The frames that a course of legs comes to, for whoever moves what legs hang on.
#pragma once

#include <array>

#include "generator/actions/action.h"

namespace contort {

// The present frame, those within a cycle of a gait from now on or at the lowest point of a bend, and where it stands.
using FramesAhead = std::array<GaitFrame, 16>;
FramesAhead frames_ahead(const WholeBody& course);

}  // namespace contort
