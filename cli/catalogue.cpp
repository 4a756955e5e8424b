#include <optional>

#include "checks/check.h"
#include "checks/clip_checks.h"
#include "cli/catalogue_fields.h"
#include "cli/variants.h"
#include "fuzz/profile.h"
#include "generator/actions/action.h"
#include "model/character/character.h"

namespace contort::cli {

Json list_characters(const Library& library) {
  Json out = Json::array();
  for (const auto& [name, desc] : library.characters) {
    Json slots = Json::object();
    for (const SlotDesc& slot : desc.slots) slots[slot.name] = slot.parts;
    out.push_back({{"name", name}, {"help", desc.help}, {"slots", slots}, {"objects", desc.objects}});
  }
  return out;
}

Json list_parts(const Library& library) {
  Json out = Json::array();
  for (const auto& [name, part] : library.parts) {
    Json joints = Json::array();
    for (const JointDesc& joint : part.joints) joints.push_back(joint.name);
    out.push_back({{"name", name}, {"kind", part.kind}, {"help", part.help}, {"joints", joints}});
  }
  return out;
}

namespace {

std::string type_text(const ParamDef& def) {
  switch (def.type) {
    case ParamType::number: return "number";
    case ParamType::vector: return "three numbers";
    case ParamType::object_point:
    case ParamType::own_point: return "name";
    case ParamType::choice: break;
  }
  std::string words;
  for (const std::string& word : def.choices) words += (words.empty() ? "" : " or ") + word;
  return words;
}

Json param_json(const ParamDef& def) {
  return {{"name", def.name}, {"type", type_text(def)},   {"low", def.low},
          {"high", def.high}, {"optional", def.optional}, {"help", def.help}};
}

Json params_json(const std::vector<ParamDef>& defs) {
  Json params = Json::array();
  for (const ParamDef& def : defs) params.push_back(param_json(def));
  return params;
}

// An action's parameters can depend on the part: shown for each part that can do it. `desc` is nullptr for a built-in
// action.
Json list_action(const Library& library, std::string_view name, const ActionDesc* desc) {
  Json out = {{"name", name}, {"params_on", Json::object()}};
  for_variants(library, [&](const Character& character) {
    for (const Part& part : character.parts()) {
      const std::optional<Action> action = find_action(character, part, name);
      if (!action || out["params_on"].contains(part.name)) continue;
      if (desc == nullptr ? action->desc != nullptr : action->desc == nullptr || *action->desc != *desc) continue;
      out["params_on"][part.name] = params_json(params_of(*action, character, part));
      out["layer"] = layer_name(action->def->layer);
      out["timing"] = action->def->timing == Timing::goal ? "goal" : "course";
      out["help"] = action->help;
    }
  });
  return out;
}

}  // namespace

Json list_actions(const Library& library) {
  Json out = Json::array();
  for (const ActionDef& action : all_actions()) out.push_back(list_action(library, action.name, nullptr));
  for (const ActionDesc& desc : library.actions) out.push_back(list_action(library, desc.name, &desc));
  return out;
}

Json list_checks(const Library&) {
  Json out = Json::array();
  for (const CheckDef& check : all_checks())
    out.push_back(
        {{"name", check.name}, {"scale", check.scale}, {"resolution", check.resolution}, {"help", check.help}});
  for (const ClipCheckDef& check : clip_checks())
    out.push_back({{"name", check.name}, {"scale", check.scale}, {"resolution", 0.0}, {"help", check.help}});
  return out;
}

// Each as the file that a profile of one's own may start from.
Json list_profiles(const Library&) {
  Json list = Json::array();
  for (const Profile& profile : built_in_profiles())
    list.push_back({{"name", profile.name}, {"help", profile.about}, {"profile", Json::parse(print_profile(profile))}});
  return list;
}

}  // namespace contort::cli
