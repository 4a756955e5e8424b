#include "cli/usage_text.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "model/core/nearest.h"

namespace contort::cli {

namespace {

const CLI::App& deepest_called(const CLI::App& app) {
  const std::vector<CLI::App*> called = app.get_subcommands();
  return called.empty() ? app : deepest_called(*called.front());
}

// The name of an option: "--charcter" in "--charcter=mech".
std::string name_of(const std::string& word) { return word.substr(0, word.find('=')); }

// The first word after the command that is neither an option nor the value of one.
std::string first_word(const CLI::App& command, bool is_program, int argc, char** argv) {
  bool was_called = is_program;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with("-") && was_called) return word;
    was_called = was_called || word == command.get_name();
    const CLI::Option* option = word.starts_with("-") ? command.get_option_no_throw(word) : nullptr;
    if (option != nullptr && option->get_items_expected_min() > 0) ++i;
  }
  return "";
}

// The option that the parser does not know: the first one that neither the command nor the program has.
std::string unknown_option(const CLI::App& app, const CLI::App& command, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string name = name_of(argv[i]);
    if (name == "--") return "";
    if (!name.starts_with("--")) continue;
    if (command.get_option_no_throw(name) == nullptr && app.get_option_no_throw(name) == nullptr) return name;
  }
  return "";
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  const auto found = app.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

std::string command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return joined(names);
}

std::string option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return joined(names);
}

std::string usage_text(const CLI::App& app, int argc, char** argv, const CLI::ParseError& error) {
  const auto is = [&](CLI::ExitCodes code) { return error.get_exit_code() == static_cast<int>(code); };
  if (!is(CLI::ExitCodes::ExtrasError) && !is(CLI::ExitCodes::RequiredError)) return error.what();
  const CLI::App& command = deepest_called(app);
  const std::string commands = command_names(command);
  const std::string word = commands.empty() ? "" : first_word(command, &command == &app, argc, argv);
  if (!word.empty())
    return "there is no command \"" + word + "\"; there are " + commands + did_you_mean(word, commands);
  const std::string option = unknown_option(app, command, argc, argv);
  if (option.empty()) return error.what();
  return "there is no option " + option + did_you_mean(option, option_names(command) + ", " + option_names(app));
}

std::function<std::string(const std::string&)> one_of(std::vector<std::string> words) {
  return [words, names = joined(words)](const std::string& word) -> std::string {
    if (std::ranges::find(words, word) != words.end()) return "";
    return "found \"" + word + "\", allowed are " + names + did_you_mean(word, names);
  };
}

}  // namespace contort::cli
