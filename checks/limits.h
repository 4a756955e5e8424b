// Rules of settings on one check's margins.
#pragma once

#include "checks/check.h"

namespace contort {

// Tells the fold what the rules add to the margins of this check. Rules for one phase need the intent; without one no
// frame has a phase, and they do nothing.
void apply_limits(const CheckDef& check, const CheckInput& in, MarginFold& fold);

}  // namespace contort
