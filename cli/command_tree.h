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
  std::vector<std::string> names{};  // "-o", "--output"; empty where the place in the command line tells the option
  std::string value{};               // "DIR"; of a flag ""
  std::string about{};
  std::string default_value{};
  bool is_required = false;
  bool may_repeat = false;

  bool is_positional() const { return names.empty(); }
  bool operator==(const OptionEntry&) const = default;
};

struct CommandEntry {
  std::string name{};  // "corpus list"; of the program itself ""
  std::string about{};
  std::string footer{};
  std::vector<OptionEntry> options{};
  std::vector<std::string> commands{};  // last words of the commands below: "list"

  bool operator==(const CommandEntry&) const = default;
};

// The program itself, and behind each command those below it.
std::vector<CommandEntry> command_tree(const CLI::App& program);

}  // namespace contort::cli
