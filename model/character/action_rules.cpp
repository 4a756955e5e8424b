#include "model/character/action_rules.h"

#include <algorithm>

namespace contort {

namespace {

Result<Done> check_keys(const ActionDesc& action) {
  double before = 0.0;
  for (std::size_t i = 0; i < action.keys.size(); ++i) {
    const std::string pointer = "/keys/" + std::to_string(i);
    if (!(action.keys[i].at > before))
      return Issue{"action.bad_key", pointer + "/at", "each key must come after the one before it, and after 0"};
    if (action.keys[i].pose.empty()) return Issue{"action.bad_key", pointer + "/pose", "a key without a joint"};
    before = action.keys[i].at;
  }
  return Done{};
}

std::string common(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto found = std::ranges::find_first_of(a, b);
  return found == a.end() ? "" : *found;
}

}  // namespace

Result<Done> check_action(const ActionDesc& action) {
  if (action.parts.empty() == action.kinds.empty())
    return Issue{"action.no_part", action.parts.empty() ? "" : "/kinds", "an action is for parts or for kinds of parts"};
  if (action.keys.empty() && action.of.empty()) return Issue{"action.no_rule", "", "neither keys nor of"};
  if (!action.keys.empty() && !action.of.empty()) return Issue{"action.two_rules", "/of", "keys are there already"};
  if (action.of.empty() && !action.params.empty())
    return Issue{"action.bad_params", "/params", "key poses take no parameters"};
  return check_keys(action);
}

std::string clash(const ActionDesc& a, const ActionDesc& b) {
  if (a.name != b.name) return "";
  const std::string part = common(a.parts, b.parts);
  return part.empty() ? common(a.kinds, b.kinds) : part;
}

}  // namespace contort
