// Applies the rules of the settings to the margins of one check.
#pragma once

#include "checks/check.h"

namespace contort {

// Passes the tolerances of the rules for this check to the fold. Rules for one phase need the intent; without it
// frames have no phase, and these rules have no effect.
void apply_limits(const CheckDef& check, const CheckInput& in, MarginFold& fold);

}  // namespace contort
