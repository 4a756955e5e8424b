// The commands and options of the program as plain values, read from its own parser. The manual page and the
// completions of shells are made of them, so that they have every option that the program has.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace contort::cli {

struct OptionEntry {
  std::vector<std::string> names{};  // "-o", "--output"; empty for arguments by position
  std::string value{};               // "DIR"; "" for a flag
  std::string about{};
  std::string default_value{};
  bool is_required = false;
  bool may_repeat = false;

  bool is_positional() const { return names.empty(); }
  bool operator==(const OptionEntry&) const = default;
};

struct CommandEntry {
  std::string name{};  // "corpus list"; "" for the program itself
  std::string about{};
  std::string footer{};
  std::vector<OptionEntry> options{};
  std::vector<std::string> commands{};  // last words of the subcommands: "list"

  bool operator==(const CommandEntry&) const = default;
};

// The program, and after each command its subcommands.
std::vector<CommandEntry> command_tree(const CLI::App& program);

}  // namespace contort::cli
