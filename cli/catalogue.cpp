#include <optional>

#include "checks/check.h"
#include "cli/catalogue_fields.h"
#include "cli/variants.h"
#include "fuzz/profile.h"
#include "model/character/character.h"

namespace contort::cli {

Json list_characters(Generator& generator) {
  Json out = Json::array();
  for (const auto& [name, desc] : generator.manifest().library->characters) {
    Json slots = Json::object();
    for (const SlotDesc& slot : desc.slots) slots[slot.name] = slot.parts;
    out.push_back({{"name", name}, {"help", desc.help}, {"slots", slots}, {"objects", desc.objects}});
  }
  return out;
}

Json list_parts(Generator& generator) {
  Json out = Json::array();
  for (const auto& [name, part] : generator.manifest().library->parts) {
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

// Lists an action for each part that can perform it, because its parameters may depend on the part. `file` as in
// OfferedAction.
Json list_action(Generator& generator, const std::string& name, int file) {
  Json out = {{"name", name}, {"params_on", Json::object()}};
  for_variants(*generator.manifest().library, [&](const Character& character) {
    const Offers& offers = generator.offers(character);
    for (std::size_t p = 0; p < offers.size(); ++p) {
      const OfferedAction* action = find_offer(offers, static_cast<int>(p), name);
      const std::string& part = character.parts()[p].name;
      if (action == nullptr || action->file != file || out["params_on"].contains(part)) continue;
      out["params_on"][part] = params_json(action->params);
      out["layer"] = layer_name(action->layer);
      out["timing"] = action->timing == Timing::goal ? "goal" : "course";
      out["help"] = action->help;
    }
  });
  return out;
}

}  // namespace

// Lists the generator's own actions first, then those of files. An action of a file may have the name of another one.
Json list_actions(Generator& generator) {
  const std::vector<ActionDesc>& files = generator.manifest().library->actions;
  Json out = Json::array();
  for (const std::string& name : generator.manifest().actions)
    if (Json own = list_action(generator, name, -1); own.contains("layer")) out.push_back(std::move(own));
  for (std::size_t i = 0; i < files.size(); ++i)
    out.push_back(list_action(generator, files[i].name, static_cast<int>(i)));
  return out;
}

Json list_checks(Generator&) {
  Json out = Json::array();
  for (const CheckDef& check : all_checks())
    out.push_back(
        {{"name", check.name}, {"scale", check.scale}, {"resolution", check.resolution}, {"help", check.help}});
  return out;
}

// Lists each profile in the form of a file, from which users can start their own.
Json list_profiles(Generator&) {
  Json list = Json::array();
  for (const Profile& profile : built_in_profiles())
    list.push_back({{"name", profile.name}, {"help", profile.about}, {"profile", Json::parse(print_profile(profile))}});
  return list;
}

}  // namespace contort::cli
