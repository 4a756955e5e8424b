// Checks the rules that the fields of an action file must satisfy together, beyond the limits of each field, as far
// as they do not depend on a part.
#pragma once

#include <string>

#include "model/character/action_desc.h"
#include "model/core/result.h"

namespace contort {

// Checks an action. Codes action.no_part, .no_rule, .two_rules, .bad_key, .bad_params, with pointers into the file.
Result<Done> check_action(const ActionDesc& action);

// Returns the part or kind for which two actions of one name would conflict; "" if there is none.
std::string clash(const ActionDesc& a, const ActionDesc& b);

}  // namespace contort
