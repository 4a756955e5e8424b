// contort list, contort schema, contort version: what there is, from the manifests.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <set>

#include "checks/check.h"
#include "checks/joint_map.h"
#include "cli/commands.h"
#include "cli/variants.h"
#include "corpus/bucket.h"
#include "corpus/case.h"
#include "fuzz/profile.h"
#include "generator/actions/action.h"
#include "generator/character/character.h"
#include "generator/core/json_fields.h"

namespace contort::cli {

namespace {

using json_fields::Json;

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
  return out;
}

std::string range_text(const Json& param) {
  char text[80];
  std::snprintf(text, sizeof text, "[%g, %g]", param["low"].get<double>(), param["high"].get<double>());
  return text;
}

void print_params(const Json& action) {
  std::set<std::string> shown;  // parts of one shape have the same parameters
  for (const auto& [part, params] : action["params_on"].items()) {
    if (!shown.insert(params.dump()).second) continue;
    std::printf("    on %s\n", part.c_str());
    for (const Json& param : params)
      std::printf("      %-22s %-13s %-14s %s\n", param["name"].get<std::string>().c_str(),
                  param["type"].get<std::string>().c_str(), range_text(param).c_str(),
                  param["help"].get<std::string>().c_str());
  }
}

// Each as the file that a profile of one's own may start from.
Json list_profiles(const Library&) {
  Json list = Json::array();
  for (const Profile& profile : built_in_profiles())
    list.push_back({{"name", profile.name}, {"help", profile.about}, {"profile", Json::parse(print_profile(profile))}});
  return list;
}

// docs/actions.md is this, and a test compares them.
void print_markdown(const Json& list) {
  std::printf("# Actions\n\nWritten by `contort list actions --markdown`. Layers and timings: `docs/timeline.md`.\n");
  for (const Json& action : list) {
    const auto text = [&](const char* key) { return action[key].get<std::string>(); };
    std::printf("\n## %s\n\n%s Layer `%s`, a %s.\n", text("name").c_str(), text("help").c_str(), text("layer").c_str(),
                text("timing").c_str());
    if (action["params_on"].empty()) continue;
    const auto first = action["params_on"].begin();
    std::printf("\nOn `%s`:\n\n| parameter | type | range | meaning |\n|---|---|---|---|\n", first.key().c_str());
    for (const Json& param : first.value()) {
      const bool ranged = param["low"] != param["high"];
      std::printf("| `%s` | %s | %s | %s |\n", param["name"].get<std::string>().c_str(),
                  param["type"].get<std::string>().c_str(), ranged ? range_text(param).c_str() : "",
                  param["help"].get<std::string>().c_str());
    }
  }
}

void print_slots(const Json& character) {
  for (const auto& [slot, parts] : character["slots"].items()) {
    std::string names;
    for (const Json& part : parts) names += (names.empty() ? "" : ", ") + part.get<std::string>();
    std::printf("    %-12s %s\n", slot.c_str(), names.c_str());
  }
}

void print_text(const Json& list) {
  for (const Json& item : list) {
    std::printf("%-18s %s\n", item["name"].get<std::string>().c_str(), item["help"].get<std::string>().c_str());
    if (item.contains("params_on")) print_params(item);
    if (item.contains("slots")) print_slots(item);
  }
}

using Lister = std::function<Json(const Library&)>;
const std::map<std::string, Lister>& listers() {
  static const std::map<std::string, Lister> all = {
      {"characters", list_characters}, {"parts", list_parts}, {"actions", list_actions}, {"checks", list_checks},
      {"profiles", list_profiles}};
  return all;
}

const std::map<std::string, std::function<std::string()>>& schemas() {
  static const std::map<std::string, std::function<std::string()>> all = {
      {"spec", spec_schema},     {"case", case_schema},           {"part", part_schema},
      {"object", object_schema}, {"character", character_schema}, {"action", action_schema},
      {"map", joint_map_schema}, {"settings", settings_schema},   {"bucket", bucket_schema},
      {"profile", profile_schema}};
  return all;
}

}  // namespace

void add_list(CLI::App& app, Context& context) {
  struct Options {
    std::string what;
    bool json = false;
    bool markdown = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("list", "List characters, parts, actions, checks or profiles");
  command->add_option("WHAT", options->what, "characters, parts, actions, checks or profiles")
      ->required()
      ->check(CLI::IsMember(listers()));
  command->add_flag("--json", options->json, "Print as JSON");
  command->add_flag("--markdown", options->markdown, "Print actions as docs/actions.md")->excludes("--json");
  command->footer("Example: contort list actions");
  command->callback([options, &context] {
    const Library* library = context.load_library();
    if (library == nullptr) return;
    const Json list = listers().at(options->what)(*library);
    if (options->markdown && options->what != "actions")
      context.fail({"usage", "", "--markdown is for actions"});
    else if (options->markdown)
      print_markdown(list);
    else if (options->json)
      std::printf("%s\n", list.dump(2).c_str());
    else
      print_text(list);
  });
}

void add_schema(CLI::App& app, Context&) {
  auto what = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of a file format");
  command->add_option("FORMAT", *what, "Name of the format")
      ->required()
      ->check(CLI::IsMember(schemas()));
  command->footer("Example: contort schema spec > spec.schema.json");
  command->callback([what] { std::printf("%s", schemas().at(*what)().c_str()); });
}

void add_version(CLI::App& app, Context&) {
  CLI::App* command = app.add_subcommand("version", "Print the version");
  command->footer("Example: contort version");
  command->callback([] { std::printf("contort %s\n", CONTORT_VERSION); });
}

}  // namespace contort::cli
