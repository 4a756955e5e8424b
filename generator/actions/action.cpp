#include "generator/actions/action.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/nearest.h"
#include "model/core/number_text.h"

namespace contort {

#define X(name, layer, timing, spread, promise, tells, help)          \
  std::vector<ParamDef> name##_params(const Character&, const Part&); \
  bool name##_supports(const Character&, const Part&);                \
  void name##_rule(const RuleInput&, Posture&);
#include "generator/actions/action_list.inc"
#undef X

std::span<const ActionDef> all_actions() {
  static const ActionDef actions[] = {
#define X(name, layer, timing, spread, promise, tells, help)                \
  {#name,          Layer::layer, Timing::timing, Spread::spread,  Promise::promise, \
   Tells::tells,   help,         name##_params,  name##_supports, name##_rule},
#include "generator/actions/action_list.inc"
#undef X
  };
  return actions;
}

const ActionDef* find_action(std::string_view name) {
  for (const ActionDef& action : all_actions())
    if (action.name == name) return &action;
  return nullptr;
}

bool is_trunk(const Character& character, int part) {
  int carried = 0;
  for (int p = part + 1; p < static_cast<int>(character.parts().size()); ++p)
    carried += carrier_of(character, p) == part;
  return carried > 1;
}

namespace {

// Returns true if the part, or one on the way down to it, is carried by `carrier` or is it.
bool hangs_on(const Character& character, int part, int carrier) {
  while (part > carrier) part = carrier_of(character, part);
  return part == carrier;
}

bool faces(const Part& part, int socket) { return !part.facing.empty() && part.facing.front().socket == socket; }

// Visits the points of attached objects that others carry, or what the part can point itself: its face, and the grips
// and objects' points that it carries.
// (name, socket index).
template <class Visit>
void for_points(const Character& character, const Part& part, ParamType type, Visit visit) {
  const int own = static_cast<int>(&part - character.parts().data());
  const bool alone = is_trunk(character, own);
  for (std::size_t s = 0; s < character.sockets().size(); ++s) {
    const Socket& socket = character.sockets()[s];
    const std::string name = socket.name.substr(socket.name.find('/') + 1);
    const bool of_object = socket.name.starts_with("object:");
    const int carrier = character.joints()[static_cast<std::size_t>(socket.joint)].part;
    const bool mine = alone && type == ParamType::own_point ? carrier == own : hangs_on(character, carrier, own);
    if (type == ParamType::object_point ? of_object && !mine
                                        : mine && (of_object || name == "grip" || faces(part, static_cast<int>(s))))
      visit(name, static_cast<int>(s));
  }
}

std::vector<std::string> points_of(const Character& character, const Part& part, ParamType type) {
  std::vector<std::string> names;
  for_points(character, part, type, [&](const std::string& name, int) { names.push_back(name); });
  return names;
}

}  // namespace

std::vector<std::string> object_points(const Character& character, const Part& part) {
  return points_of(character, part, ParamType::object_point);
}
std::vector<std::string> own_points(const Character& character, const Part& part) {
  return points_of(character, part, ParamType::own_point);
}

std::vector<int> parts_moved(const ActionDef& action, const Character& character, int named_part) {
  std::vector<int> moved = {named_part};
  if (action.spread == Spread::own) return moved;
  if (action.spread == Spread::legs) {
    for (const Leg& leg : find_legs(character)) {
      moved.push_back(leg.part);
      if (leg.foot_part != leg.part) moved.push_back(leg.foot_part);
    }
    return moved;
  }
  if (is_trunk(character, named_part)) return moved;
  for (int p = named_part + 1; p < static_cast<int>(character.parts().size()); ++p)
    if (carrier_of(character, p) == moved.back()) moved.push_back(p);
  return moved;
}

namespace {

Issue param_issue(const char* code, const std::string& name, std::string text) {
  return {std::string("spec.") + code, "/params/" + name, std::move(text)};
}

std::string names_of(const std::vector<ParamDef>& defs) {
  std::string text;
  for (const ParamDef& def : defs) text += (text.empty() ? "" : ", ") + def.name;
  return text.empty() ? "none" : text;
}

Result<Done> append_point(const Character& character, const Part& part, const ParamDef& def, const ParamValue& value,
                          std::vector<double>& bound) {
  if (!std::holds_alternative<std::string>(value)) return param_issue("wrong_type", def.name, "expected a name");
  int found = -1;
  std::string names;
  for_points(character, part, def.type, [&](const std::string& name, int socket) {
    if (name == std::get<std::string>(value)) found = socket;
    names += (names.empty() ? "" : ", ") + name;
  });
  if (found < 0)
    return param_issue("unknown_point", def.name,
                       "found \"" + std::get<std::string>(value) + "\", allowed are " + names +
                           did_you_mean(std::get<std::string>(value), names));
  bound.push_back(found);
  return Done{};
}

Result<Done> append_choice(const ParamDef& def, const ParamValue& value, std::vector<double>& bound) {
  if (!std::holds_alternative<std::string>(value)) return param_issue("wrong_type", def.name, "expected a word");
  const auto found = std::find(def.choices.begin(), def.choices.end(), std::get<std::string>(value));
  std::string words;
  for (const std::string& word : def.choices) words += (words.empty() ? "" : ", ") + word;
  if (found == def.choices.end())
    return param_issue("out_of_range", def.name,
                       "found \"" + std::get<std::string>(value) + "\", allowed are " + words);
  bound.push_back(static_cast<double>(found - def.choices.begin()));
  return Done{};
}

Issue out_of_range(const ParamDef& def, double value) {
  return param_issue(
      "out_of_range", def.name,
      "found " + number_text(value) + ", allowed is [" + number_text(def.low) + ", " + number_text(def.high) + "]");
}

Result<Done> append(const ParamDef& def, const ParamValue& value, std::vector<double>& bound) {
  if (def.type == ParamType::choice) return append_choice(def, value, bound);
  const bool right =
      def.type == ParamType::number ? std::holds_alternative<double>(value) : std::holds_alternative<Vec3>(value);
  if (!right)
    return param_issue("wrong_type", def.name,
                       def.type == ParamType::number ? "expected a number" : "expected three numbers");
  const Vec3 numbers = def.type == ParamType::number ? Vec3(std::get<double>(value)) : std::get<Vec3>(value);
  const int count = def.type == ParamType::number ? 1 : 3;
  for (int i = 0; i < count; ++i) {
    if (!(numbers[i] >= def.low && numbers[i] <= def.high)) return out_of_range(def, numbers[i]);
    bound.push_back(numbers[i]);
  }
  return Done{};
}

}  // namespace

Result<Done> check_value(const ParamDef& def, const ParamValue& value) {
  std::vector<double> unused;
  return append(def, value, unused);
}

namespace {

Issue unknown_param(const Action& action, const Part& part, const std::string& name, const std::string& allowed) {
  return param_issue("unknown_param", name,
                     "part " + part.name + " with action " + std::string(action.name) + " takes " + allowed +
                         did_you_mean(name, allowed));
}

void append_nothing(const ParamDef& def, std::vector<double>& bound) {
  bound.insert(bound.end(), def.type == ParamType::number ? 1 : 3, std::numeric_limits<double>::quiet_NaN());
}

bool is_point(const ParamDef& def) {
  return def.type == ParamType::object_point || def.type == ParamType::own_point;
}

}  // namespace

Result<std::vector<double>> bind_params(const Action& action, const Character& character, const Part& part,
                                        const std::map<std::string, ParamValue>& values) {
  const std::vector<ParamDef> defs = params_of(action, character, part);
  for (const auto& value : values)
    if (std::none_of(defs.begin(), defs.end(), [&](const ParamDef& def) { return def.name == value.first; }))
      return unknown_param(action, part, value.first, names_of(defs));
  std::vector<double> bound;
  for (const ParamDef& def : defs) {
    const auto given = values.find(def.name);
    if (given == values.end() && def.optional) {
      append_nothing(def, bound);
      continue;
    }
    const ParamValue& value = given == values.end() ? def.preset : given->second;
    const Result<Done> done =
        is_point(def) ? append_point(character, part, def, value, bound) : append(def, value, bound);
    if (!done) return done.issue();
  }
  return bound;
}

}  // namespace contort
