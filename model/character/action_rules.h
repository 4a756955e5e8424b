// The fields of an action file must satisfy these rules together, beyond the limits of each and as far as no part is
// looked at.
#pragma once

#include <string>

#include "model/character/action_desc.h"
#include "model/core/result.h"

namespace contort {

// Codes action.no_part, .no_rule, .two_rules, .bad_key, .bad_params, with pointers into the file.
Result<Done> check_action(const ActionDesc& action);

// The part or kind for which two actions of one name would both be meant; "" where there is none.
std::string clash(const ActionDesc& a, const ActionDesc& b);

}  // namespace contort
