// Checks a profile against a generator and its library.
#include <algorithm>
#include <cmath>
#include <set>

#include "fuzz/profile.h"
#include "model/core/json_fields.h"
#include "model/core/nearest.h"
#include "model/spec/spec_fields.h"

namespace contort {

namespace {

using json_fields::quoted;

// An action of a character's part in a slot.
struct Movement {
  std::string character, slot, action;
  std::vector<ParamDef> params;
};

// The names of a library, and the movements that its characters can make.
struct Known {
  std::set<std::string> characters, slots, actions;
  std::vector<Movement> movements;
};

void add_movements(const CharacterChoice& choice, Generator& generator, std::vector<Movement>& movements) {
  const Result<Character> character = build_character(choice, *generator.manifest().library);
  if (!character) return;
  const Offers& offers = generator.offers(*character);
  for (std::size_t p = 0; p < offers.size(); ++p)
    for (const OfferedAction& action : offers[p])
      movements.push_back({choice.name, character->parts()[p].slot, action.name, action.params});
}

Known known_of(Generator& generator) {
  Known known;
  const Manifest& manifest = generator.manifest();
  for (const auto& [name, desc] : manifest.library->characters) {
    known.characters.insert(name);
    add_movements({name, {}, {}}, generator, known.movements);
    for (const SlotDesc& slot : desc.slots) {
      known.slots.insert(slot.name);
      for (const std::string& part : slot.parts)
        add_movements({name, {{slot.name, part}}, {}}, generator, known.movements);
    }
  }
  known.actions.insert(manifest.actions.begin(), manifest.actions.end());
  return known;
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Result<Done> check_known(const std::vector<std::string>& names, const std::set<std::string>& known,
                         const std::string& pointer, const std::string& kind) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!known.contains(names[i]))
      return Issue{"profile.unknown_name", pointer + "/" + std::to_string(i),
                   quoted(names[i]) + " is not one of the library's " + kind + did_you_mean(names[i], joined(known))};
  return Done{};
}

bool is_blend(std::string_view param) { return param == "blend_in_frames" || param == "blend_out_frames"; }

Result<Done> check_blend(const DrawRule& rule, const std::string& pointer) {
  const auto good = [](double frames) {
    return frames >= kBlendOut.low && frames <= kBlendOut.high && std::floor(frames) == frames;
  };
  if (rule.low.size() == 1 && good(rule.low[0]) && good(rule.high[0])) return Done{};
  return Issue{"profile.bad_rule", pointer + "/low",
               rule.param + " is one whole number, from 0 to " + std::to_string(static_cast<int>(kBlendOut.high))};
}

// Checks that a parameter can have a value that the rule allows.
Result<Done> check_range(const DrawRule& rule, const ParamDef& def, const Movement& of, const std::string& pointer) {
  const std::string whose = "of " + of.action + " in slot " + of.slot + " of " + of.character;
  if (def.type != ParamType::number && def.type != ParamType::vector)
    return Issue{"profile.bad_rule", pointer + "/param",
                 quoted(def.name) + " " + whose + " is no number and no vector"};
  if (def.type == ParamType::number && rule.low.size() != 1)
    return Issue{"profile.bad_rule", pointer + "/low", quoted(def.name) + " " + whose + " is one number"};
  for (std::size_t i = 0; i < rule.low.size(); ++i)
    if (rule.low[i] > def.high || rule.high[i] < def.low)
      return Issue{"profile.no_range", pointer + "/low/" + std::to_string(i),
                   quoted(def.name) + " " + whose + " lies within " + json_fields::Json(def.low).dump() + " and " +
                       json_fields::Json(def.high).dump()};
  return Done{};
}

Result<Done> check_param(const DrawRule& rule, const Known& known, const std::string& pointer) {
  if (is_blend(rule.param)) return check_blend(rule, pointer);
  bool found = false;
  for (const Movement& movement : known.movements)
    for (const ParamDef& def : movement.params) {
      if (def.name != rule.param || !rule.speaks_of(movement.slot, movement.action)) continue;
      found = true;
      if (const Result<Done> good = check_range(rule, def, movement, pointer); !good) return good;
    }
  if (found) return Done{};
  return Issue{"profile.unknown_name", pointer + "/param",
               "no action that the rule speaks of has a parameter " + quoted(rule.param)};
}

Result<Done> check_rule(const DrawRule& rule, const Known& known, const std::string& pointer) {
  if (const Result<Done> all = check_known(rule.slots, known.slots, pointer + "/slots", "slots"); !all) return all;
  if (const Result<Done> all = check_known(rule.actions, known.actions, pointer + "/actions", "actions"); !all)
    return all;
  const bool speaks = std::ranges::any_of(
      known.movements, [&](const Movement& movement) { return rule.speaks_of(movement.slot, movement.action); });
  if (!speaks)
    return Issue{"profile.unknown_name", pointer + "/actions", "no part in these slots has one of these actions"};
  return rule.param.empty() ? Result<Done>(Done{}) : check_param(rule, known, pointer);
}

// Every character must be able to move. Characters that the library does not have are refused when they are built.
Result<Done> check_moves(const Profile& profile, const std::vector<std::string>& characters, const Known& known) {
  const DrawRule allowed{profile.slots, profile.actions, false, {}, {}, {}, 0};
  for (const std::string& character : characters) {
    if (!known.characters.contains(character)) continue;
    const bool moves = std::ranges::any_of(known.movements, [&](const Movement& m) {
      return m.character == character && allowed.speaks_of(m.slot, m.action) && !profile.never(m.slot, m.action);
    });
    if (!moves)
      return Issue{"profile.nothing_moves", "",
                   "slots, actions and rules of the profile leave " + quoted(character) + " no action at all"};
  }
  return Done{};
}

}  // namespace

Result<Done> validate(const Profile& profile, const std::vector<std::string>& characters, Generator& generator) {
  const Known known = known_of(generator);
  for (const auto& [names, of_library, field] :
       {std::tuple(&profile.characters, &known.characters, "characters"),
        std::tuple(&profile.slots, &known.slots, "slots"), std::tuple(&profile.actions, &known.actions, "actions")})
    if (const Result<Done> all = check_known(*names, *of_library, std::string("/") + field, field); !all) return all;
  const std::set<std::string> grounds = {"plane", "slope", "steps", "heights"};
  if (const Result<Done> all = check_known(profile.grounds, grounds, "/grounds", "grounds"); !all) return all;
  for (std::size_t i = 0; i < profile.rules.size(); ++i)
    if (const Result<Done> good = check_rule(profile.rules[i], known, "/rules/" + std::to_string(i)); !good)
      return good;
  return check_moves(profile, characters, known);
}

}  // namespace contort
