// Actions of a user's own, from files: which parts can do them, and what they take.
#include <algorithm>

#include "generator/actions/action.h"

namespace contort {

std::vector<ParamDef> pose_params(const Character&, const Part&);  // a row of action_list.inc

namespace {

const ParamDef* find_param(const std::vector<ParamDef>& defs, const std::string& name) {
  const auto found = std::ranges::find(defs, name, &ParamDef::name);
  return found == defs.end() ? nullptr : &*found;
}

// Returns an issue if the part has no such parameter, or a value does not fit it. Points of objects are checked later,
// when a spec says what the part carries.
Result<Done> check_values(const std::vector<ParamDef>& defs, const std::map<std::string, ParamValue>& values,
                          const Part& part, const std::string& pointer) {
  for (const auto& [name, value] : values) {
    const ParamDef* def = find_param(defs, name);
    if (def == nullptr)
      return Issue{"action.unknown_param", pointer + "/" + name, "part " + part.name + " has no such parameter"};
    if (def->type == ParamType::object_point || def->type == ParamType::own_point) continue;
    if (const Result<Done> done = check_value(*def, value); !done)
      return Issue{"action" + done.issue().code.substr(4), pointer + "/" + name, done.issue().text};
  }
  return Done{};
}

// Returns an issue if the script declares to set a parameter that it may not set.
Result<Done> check_sets(const std::vector<ParamDef>& defs, const ActionDesc& desc, const Part& part) {
  for (std::size_t i = 0; i < desc.sets.size(); ++i)
    if (const ParamDef* def = find_param(defs, desc.sets[i]); def == nullptr || def->type == ParamType::choice)
      return Issue{"action.unknown_param", "/sets/" + std::to_string(i),
                   "part " + part.name + " has no number or vector \"" + desc.sets[i] + "\""};
  for (std::size_t i = 0; i < desc.parameters.size(); ++i)
    if (find_param(defs, desc.parameters[i].name) != nullptr)
      return Issue{"action.duplicate_name", "/parameters/" + std::to_string(i) + "/name",
                   "\"" + desc.parameters[i].name + "\" is a parameter of \"" + (desc.of.empty() ? "pose" : desc.of) +
                       "\""};
  return Done{};
}

Result<Done> can_move_joints(const ActionDesc& desc, const Character& character, const Part& part) {
  const std::vector<ParamDef> defs = pose_params(character, part);
  for (std::size_t i = 0; i < desc.keys.size(); ++i) {
    const std::string pointer = "/keys/" + std::to_string(i) + "/pose";
    if (const Result<Done> done = check_values(defs, desc.keys[i].pose, part, pointer); !done) return done;
  }
  return check_sets(defs, desc, part);
}

// Why a part cannot do the action of a file, if it cannot.
Result<Done> can_do(const ActionDesc& desc, const Character& character, const Part& part) {
  if (desc.of.empty()) return can_move_joints(desc, character, part);
  const ActionDef* def = find_action(desc.of);
  if (def == nullptr) return Issue{"action.unknown_action", "/of", "found \"" + desc.of + "\", which is not built in"};
  if (!def->supports(character, part))
    return Issue{"action.unsupported", "/of", "part " + part.name + " cannot do \"" + desc.of + "\""};
  if (!desc.script.empty() && !takes_computed_params(*def, character, part))
    return Issue{"action.unsupported", "/script", "\"" + desc.of + "\" plans ahead: its parameters cannot be computed"};
  const std::vector<ParamDef> defs = def->params(character, part);
  if (Result<Done> done = check_sets(defs, desc, part); !done) return done;
  return check_values(defs, desc.params, part, "/params");
}

Action of_file(const ActionDesc& desc) { return {desc.name, desc.help, def_of(desc), &desc}; }

Result<Done> can_do_and_compute(const ActionDesc& desc, const Character& character, const Part& part) {
  Result<Done> answer = can_do(desc, character, part);
  return answer && !desc.script.empty() ? try_script(desc, character, part) : std::move(answer);
}

// Returns an issue if the part cannot perform the action in some slot of the library that may take it. Characters that
// cannot be built are left out: they have a fault of their own.
Result<Done> can_do_everywhere(const ActionDesc& desc, const Library& library, const std::string& part_name) {
  Result<Done> answer = Done{};
  for (const auto& [name, character_desc] : library.characters)
    for (const SlotDesc& slot : character_desc.slots) {
      if (std::ranges::find(slot.parts, part_name) == slot.parts.end()) continue;
      const Result<Character> character = build_character({name, {{slot.name, part_name}}, {}}, library);
      if (!character) continue;
      const Part& part = character->parts()[static_cast<std::size_t>(character->find_part(slot.name))];
      if (Result<Done> done = can_do_and_compute(desc, *character, part); !done) answer = std::move(done);
    }
  return answer;
}

Result<Done> check_named(const ActionDesc& desc, const Library& library) {
  for (std::size_t i = 0; i < desc.parts.size(); ++i) {
    if (!library.parts.contains(desc.parts[i]))
      return Issue{"action.unknown_part", "/parts/" + std::to_string(i),
                   "found \"" + desc.parts[i] + "\", which no file has"};
    if (Result<Done> done = can_do_everywhere(desc, library, desc.parts[i]); !done) return done;
  }
  return Done{};
}

// Some part of the kinds must be able to do it; the reason given is that of the last that cannot.
Result<Done> check_kinds(const ActionDesc& desc, const Library& library) {
  Result<Done> answer = Issue{"action.fits_nothing", "/kinds", "no part is of these kinds"};
  for (const auto& [name, part] : library.parts) {
    if (std::ranges::find(desc.kinds, part.kind) == desc.kinds.end()) continue;
    answer = can_do_everywhere(desc, library, name);
    if (answer) break;
  }
  return answer;
}

// A stored case with a stock part must go on meaning what it meant.
Result<Done> check_name(const ActionDesc& desc) {
  if (find_action(desc.name) == nullptr) return Done{};
  if (!desc.kinds.empty())
    return Issue{"action.duplicate_name", "/name", "\"" + desc.name + "\" is built in; only single parts may have their own"};
  for (std::size_t i = 0; i < desc.parts.size(); ++i)
    if (stock_library().parts.contains(desc.parts[i]))
      return Issue{"action.stock_part", "/parts/" + std::to_string(i),
                   "stock parts keep the built-in \"" + desc.name + "\""};
  return Done{};
}

}  // namespace

const ActionDef* def_of(const ActionDesc& desc) {
  if (desc.of.empty()) return desc.script.empty() ? &key_pose_def() : &script_def(desc.adds);
  const ActionDef* def = find_action(desc.of);
  return desc.script.empty() || def == nullptr ? def : &course_of(*def);
}

std::vector<Action> actions_of(const Character& character, const Part& part) {
  std::vector<Action> actions;
  for (const ActionDef& def : all_actions())
    if (def.supports(character, part)) actions.push_back({def.name, def.help, &def, nullptr});
  for (const ActionDesc& desc : character.actions()) {
    if (!is_for(desc, part) || !can_do(desc, character, part)) continue;
    const auto same = std::ranges::find(actions, std::string_view(desc.name), &Action::name);
    same == actions.end() ? actions.push_back(of_file(desc)) : void(*same = of_file(desc));
  }
  return actions;
}

std::optional<Action> find_action(const Character& character, const Part& part, std::string_view name) {
  for (const Action& action : actions_of(character, part))
    if (action.name == name) return action;
  return std::nullopt;
}

bool is_action_name(const Character& character, std::string_view name) {
  return find_action(name) != nullptr ||
         std::ranges::any_of(character.actions(), [&](const ActionDesc& desc) { return desc.name == name; });
}

ParamValue mirrored(Mirrored how, const ParamValue& value) {
  if (how == Mirrored::opposite) return -std::get<double>(value);
  if (how == Mirrored::point) return mirror_point(std::get<Vec3>(value));
  if (how == Mirrored::rotation) return mirror_axis(std::get<Vec3>(value));
  return value;
}

namespace {

void add_points(const Character& character, const Part& part, std::vector<ParamDef>& defs) {
  for (ParamDef& def : defs) {
    if (def.type == ParamType::object_point) def.points = object_points(character, part);
    if (def.type == ParamType::own_point) def.points = own_points(character, part);
  }
}

void add_script_params(const ActionDesc& action, std::vector<ParamDef>& defs) {
  for (const ScriptParamDesc& param : action.parameters) {
    ParamDef def;
    def.name = param.name, def.help = param.help;
    def.low = param.low, def.high = param.high, def.preset = param.preset;
    defs.push_back(std::move(def));
  }
}

}  // namespace

std::vector<ParamDef> params_of(const Action& action, const Character& character, const Part& part) {
  std::vector<ParamDef> defs = action.def->params(character, part);
  add_points(character, part, defs);
  if (action.desc == nullptr) return defs;
  add_script_params(*action.desc, defs);
  for (ParamDef& def : defs)
    if (const auto given = action.desc->params.find(def.name); given != action.desc->params.end()) {
      def.preset = part.side == Side::right ? mirrored(def.mirrored, given->second) : given->second;
      def.optional = false;
      def.is_characteristic = true;
    }
  return defs;
}

Result<Done> check_actions(const Library& library) {
  for (const ActionDesc& desc : library.actions) {
    Result<Done> done = check_name(desc);
    if (done && !desc.script.empty()) done = ScriptHost::check(desc.script);
    if (done) done = desc.kinds.empty() ? check_named(desc, library) : check_kinds(desc, library);
    if (done) continue;
    Issue issue = done.issue();
    issue.text = "action " + desc.name + ": " + issue.text;
    return issue;
  }
  return Done{};
}

}  // namespace contort
