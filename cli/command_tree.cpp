#include "cli/command_tree.h"

#include <CLI/CLI.hpp>

namespace contort::cli {

namespace {

// Returns "DIR". For a number with a range, the parser returns "INT:INT in [1 - 9]", which becomes "INT in [1 - 9]".
std::string value_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  return colon != std::string::npos && type.find(type.substr(0, colon) + " in ") == colon + 1 ? type.substr(colon + 1)
                                                                                              : type;
}

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  if (entry.is_positional())
    entry.value = option.get_name(true);
  else if (option.get_items_expected_max() > 0)
    entry.value = value_of(option);
  entry.about = option.get_description();
  entry.default_value = option.get_default_str();
  entry.is_required = option.get_required();
  entry.may_repeat = option.get_items_expected_max() > 1;
  return entry;
}

void add_entries(const CLI::App& app, const std::string& name, std::vector<CommandEntry>& entries) {
  CommandEntry entry{.name = name, .about = app.get_description(), .footer = app.get_footer()};
  for (const CLI::Option* option : app.get_options()) entry.options.push_back(entry_of(*option));
  const std::vector<const CLI::App*> below = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : below) entry.commands.push_back(command->get_name());
  entries.push_back(std::move(entry));
  for (const CLI::App* command : below)
    add_entries(*command, (name.empty() ? "" : name + " ") + command->get_name(), entries);
}

}  // namespace

std::vector<CommandEntry> command_tree(const CLI::App& program) {
  std::vector<CommandEntry> entries;
  add_entries(program, "", entries);
  return entries;
}

}  // namespace contort::cli
