// contort list, contort schema, contort version: lists the contents of the manifests.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <set>

#include "checks/joint_map.h"
#include "cli/accept_list.h"
#include "cli/catalogue_fields.h"
#include "cli/commands.h"
#include "guest/manifest.h"
#include "cli/usage_text.h"
#include "corpus/bucket.h"
#include "corpus/case.h"
#include "corpus/condition.h"
#include "fuzz/profile.h"
#include "model/character/skin_desc.h"
#include "model/core/json_fields.h"
#include "model/core/nearest.h"

namespace contort::cli {

namespace {

using json_fields::Json;

// Names and choices have no range: "".
std::string range_text(const Json& param) {
  if (param["low"] == param["high"]) return "";
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

// Prints docs/reference/actions.md; a test compares them.
void print_markdown(const Json& list) {
  std::printf(
      "# Actions\n\nThis page lists every action of the built-in generator with its parameters; "
      "`contort list actions --markdown` writes\nit. [timeline.md](timeline.md) explains layers and timings.\n");
  for (const Json& action : list) {
    const auto text = [&](const char* key) { return action[key].get<std::string>(); };
    std::printf("\n## %s\n\n%s Layer `%s`, a %s.\n", text("name").c_str(), text("help").c_str(), text("layer").c_str(),
                text("timing").c_str());
    if (action["params_on"].empty()) continue;
    const auto first = action["params_on"].begin();
    std::printf("\nOn `%s`:\n\n| parameter | type | range | meaning |\n|---|---|---|---|\n", first.key().c_str());
    for (const Json& param : first.value()) {
      std::printf("| `%s` | %s | %s | %s |\n", param["name"].get<std::string>().c_str(),
                  param["type"].get<std::string>().c_str(), range_text(param).c_str(),
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
  std::size_t width = 18;
  for (const Json& item : list) width = std::max(width, item["name"].get<std::string>().size());
  for (const Json& item : list) {
    std::printf("%-*s %s\n", static_cast<int>(width), item["name"].get<std::string>().c_str(),
                item["help"].get<std::string>().c_str());
    if (item.contains("params_on")) print_params(item);
    if (item.contains("slots")) print_slots(item);
  }
}

using Lister = std::function<Json(Generator&)>;
const std::map<std::string, Lister>& listers() {
  static const std::map<std::string, Lister> all = {{"characters", list_characters},
                                                    {"parts", list_parts},
                                                    {"actions", list_actions},
                                                    {"checks", list_checks},
                                                    {"profiles", list_profiles}};
  return all;
}

const std::map<std::string, std::function<std::string()>>& schemas() {
  static const std::map<std::string, std::function<std::string()>> all = {{"spec", spec_schema},
                                                                          {"case", case_schema},
                                                                          {"part", part_schema},
                                                                          {"object", object_schema},
                                                                          {"character", character_schema},
                                                                          {"action", action_schema},
                                                                          {"map", joint_map_schema},
                                                                          {"settings", settings_schema},
                                                                          {"accept", accept_list_schema},
                                                                          {"bucket", bucket_schema},
                                                                          {"profile", profile_schema},
                                                                          {"skin", skin_schema},
                                                                          {"rules", conditions_schema},
                                                                          {"generator", manifest_schema}};
  return all;
}

template <class Values>
std::vector<std::string> keys_of(const std::map<std::string, Values>& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
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
      ->check(one_of(keys_of(listers())));
  command->add_flag("--json", options->json, "Print as JSON");
  command->add_flag("--markdown", options->markdown, "Print actions as docs/reference/actions.md")->excludes("--json");
  command->footer("Example: contort list actions");
  command->callback([options, &context] {
    Generator* generator = context.load_generator();
    if (generator == nullptr) return;
    const Json list = listers().at(options->what)(*generator);
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
  command->add_option("FORMAT", *what, "Name of the format")->required()->check(one_of(keys_of(schemas())));
  command->footer("Example: contort schema spec > spec.schema.json");
  command->callback([what] { std::printf("%s", schemas().at(*what)().c_str()); });
}

void add_version(CLI::App& app, Context&) {
  CLI::App* command = app.add_subcommand("version", "Print the version");
  command->footer("Example: contort version");
  command->callback([] { std::printf("contort %s\n", CONTORT_VERSION); });
}

void add_help(CLI::App& app, Context& context) {
  auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("help", "Explain the program, or one command");
  command->add_option("COMMAND", *words, "Name of a command; two words for a command of a command");
  command->footer("Example: contort help fuzz\n         contort help corpus list");
  command->callback([words, &app, &context] {
    const CLI::App* explained = &app;
    std::string name = app.get_name();
    for (const std::string& word : *words) {
      const CLI::App* next = find_command(*explained, word);
      if (next == nullptr) {
        const std::string names = command_names(*explained);
        return context.fail(
            {"usage", "", "there is no command \"" + word + "\"; there are " + names + did_you_mean(word, names)});
      }
      explained = next;
      name += " " + word;
    }
    std::printf("%s", explained->get_formatter()->make_help(explained, name, CLI::AppFormatMode::Normal).c_str());
  });
}

}  // namespace contort::cli
