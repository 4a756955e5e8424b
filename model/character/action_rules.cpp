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

template <class Names>
std::string first_twice(const Names& names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      return names[i];
  return "";
}

Result<Done> check_parameters(const ActionDesc& action) {
  std::vector<std::string> names = action.sets;
  for (std::size_t i = 0; i < action.parameters.size(); ++i) {
    const ScriptParamDesc& param = action.parameters[i];
    const std::string pointer = "/parameters/" + std::to_string(i);
    names.push_back(param.name);
    if (!first_twice(names).empty())
      return Issue{"action.duplicate_name", pointer + "/name", "\"" + param.name + "\" is there already"};
    if (!(param.low <= param.preset && param.preset <= param.high))
      return Issue{"action.bad_params", pointer + "/preset", "the preset must lie between low and high"};
  }
  return Done{};
}

Result<Done> check_script_fields(const ActionDesc& action) {
  if (action.script.empty()) {
    const bool has_more = !action.sets.empty() || !action.parameters.empty() || action.adds;
    return has_more ? Result<Done>(Issue{"action.no_rule", "/script", "sets, parameters and adds belong to a script"})
                    : Result<Done>(Done{});
  }
  if (action.sets.empty()) return Issue{"action.bad_params", "/sets", "names what the script sets, one at least"};
  if (const std::string twice = first_twice(action.sets); !twice.empty())
    return Issue{"action.duplicate_name", "/sets", "\"" + twice + "\" is there twice"};
  if (action.adds && !action.of.empty())
    return Issue{"action.bad_params", "/adds", "only joints are added to; a script with `of` sets parameters"};
  return check_parameters(action);
}

std::string common(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto found = std::ranges::find_first_of(a, b);
  return found == a.end() ? "" : *found;
}

}  // namespace

Result<Done> check_action(const ActionDesc& action) {
  if (action.parts.empty() == action.kinds.empty())
    return Issue{"action.no_part", action.parts.empty() ? "" : "/kinds", "an action is for parts or for kinds of parts"};
  if (action.keys.empty() && action.of.empty() && action.script.empty())
    return Issue{"action.no_rule", "", "an action needs keys, of or a script"};
  if (!action.keys.empty() && !action.of.empty()) return Issue{"action.two_rules", "/of", "keys are there already"};
  if (!action.keys.empty() && !action.script.empty())
    return Issue{"action.two_rules", "/script", "keys are there already"};
  if (action.of.empty() && !action.params.empty())
    return Issue{"action.bad_params", "/params", "values of parameters go with `of`"};
  if (Result<Done> done = check_script_fields(action); !done) return done;
  return check_keys(action);
}

std::string clash(const ActionDesc& a, const ActionDesc& b) {
  if (a.name != b.name) return "";
  const std::string part = common(a.parts, b.parts);
  return part.empty() ? common(a.kinds, b.kinds) : part;
}

}  // namespace contort
