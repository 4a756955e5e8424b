// contort man and contort completion: prints the program's own commands for man(1) and for shells.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/command_tree.h"
#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/man_page.h"
#include "cli/usage_text.h"

namespace contort::cli {

namespace {

std::string completion_for(const std::string& shell, const CLI::App& program) {
  const std::vector<CommandEntry> commands = command_tree(program);
  if (shell == "bash") return bash_completion(commands);
  return shell == "zsh" ? zsh_completion(commands) : fish_completion(commands);
}

}  // namespace

void add_man(CLI::App& app, Context&) {
  CLI::App* command = app.add_subcommand("man", "Print the manual page with all commands and options");
  command->footer("Example: contort man | man -l -");
  command->callback([&app] { std::printf("%s", man_page(command_tree(app), CONTORT_VERSION).c_str()); });
}

void add_completion(CLI::App& app, Context&) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("completion", "Print a script with which a shell completes commands");
  command->add_option("SHELL", *shell, "bash, zsh or fish")->required()->check(one_of({"bash", "zsh", "fish"}));
  command->footer("Example: contort completion bash > ~/.local/share/bash-completion/completions/contort");
  command->callback([shell, &app] { std::printf("%s", completion_for(*shell, app).c_str()); });
}

}  // namespace contort::cli
