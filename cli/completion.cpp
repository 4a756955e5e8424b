// The three scripts work alike. They go through the words before the cursor: a command leads to its place in the tree
// ("corpus list"), and an option with a value skips the next word. The suggestions depend on that place alone. If
// neither commands nor options match, the shell completes file names.
#include "cli/completion.h"

#include <algorithm>
#include <vector>

namespace contort::cli {

namespace {

using Words = std::vector<std::string>;

std::string joined_by(const Words& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string double_quoted(const std::string& text) { return "\"" + text + "\""; }

// Quotes text in single quotes. `escape` is the shell's notation for a single quote inside of them.
std::string single_quoted(const std::string& text, const std::string& escape) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? escape : std::string(1, c);
  return out + "'";
}
std::string for_zsh(const std::string& text) { return single_quoted(text, "'\\''"); }
std::string for_fish(const std::string& text) { return single_quoted(text, "\\'"); }

// The place of a subcommand of this command.
std::string place_of(const CommandEntry& above, const std::string& command) {
  return above.name.empty() ? command : above.name + " " + command;
}

// A command's own options, and those of the program, which may follow any command.
std::vector<OptionEntry> options_at(std::span<const CommandEntry> commands, const CommandEntry& command) {
  std::vector<OptionEntry> options = command.options;
  if (!command.name.empty())
    for (const OptionEntry& option : commands.front().options)
      if (std::ranges::find(options, option.names, &OptionEntry::names) == options.end()) options.push_back(option);
  std::erase_if(options, [](const OptionEntry& option) { return option.is_positional(); });
  return options;
}

// Patterns "PLACE|WORD" of options with a value. The program's options are valid at every place.
Words patterns_with_value(std::span<const CommandEntry> commands) {
  Words patterns;
  for (const CommandEntry& command : commands)
    for (const OptionEntry& option : command.options) {
      if (option.value.empty()) continue;
      for (const std::string& name : option.names)
        patterns.push_back((command.name.empty() ? "*" : "") + double_quoted(command.name + "|" + name));
    }
  return patterns;
}

// Arms of a `case` statement, for both bash and zsh.
std::string arms_that_walk(std::span<const CommandEntry> commands) {
  std::string text;
  for (const CommandEntry& command : commands)
    for (const std::string& below : command.commands)
      text += "      " + double_quoted(command.name + "|" + below) + ") at=" + double_quoted(place_of(command, below)) +
              " ;;\n";
  for (const std::string& pattern : patterns_with_value(commands)) text += "      " + pattern + ") i=$((i + 1)) ;;\n";
  return text;
}

// Returns 'name:about', for _describe.
std::string described(const std::string& name, const std::string& about) { return for_zsh(name + ":" + about); }

const CommandEntry& entry_at(std::span<const CommandEntry> commands, const std::string& name) {
  return *std::ranges::find(commands, name, &CommandEntry::name);
}

std::string zsh_arm(std::span<const CommandEntry> commands, const CommandEntry& command) {
  Words below, options;
  for (const std::string& name : command.commands)
    below.push_back(described(name, entry_at(commands, place_of(command, name)).about));
  for (const OptionEntry& option : options_at(commands, command))
    for (const std::string& name : option.names) options.push_back(described(name, option.about));
  return "    " + double_quoted(command.name) + ")\n      commands=(" + joined_by(below, " ") + ")\n      options=(" +
         joined_by(options, "\n        ") + ") ;;\n";
}

std::string bash_arm(std::span<const CommandEntry> commands, const CommandEntry& command) {
  Words options;
  for (const OptionEntry& option : options_at(commands, command))
    options.insert(options.end(), option.names.begin(), option.names.end());
  return "    " + double_quoted(command.name) + ")\n      commands=" + double_quoted(joined_by(command.commands, " ")) +
         "\n      options=" + double_quoted(joined_by(options, " ")) + " ;;\n";
}

std::string fish_option(const OptionEntry& option, const std::string& start) {
  std::string text = start;
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  return text + (option.value.empty() ? "" : " -r") + " -d " + for_fish(option.about) + "\n";
}

std::string fish_lines(std::span<const CommandEntry> commands, const CommandEntry& command) {
  const std::string start = "complete -c contort -n " + for_fish("__contort_is_at " + double_quoted(command.name));
  std::string text;
  for (const std::string& name : command.commands)
    text += start + " -f -a " + name + " -d " + for_fish(entry_at(commands, place_of(command, name)).about) + "\n";
  for (const OptionEntry& option : options_at(commands, command)) text += fish_option(option, start);
  return text;
}

std::string fish_walk(std::span<const CommandEntry> commands) {
  std::string text;
  for (const CommandEntry& command : commands)
    for (const std::string& below : command.commands)
      text += "            case " + double_quoted(command.name + "|" + below) + "\n                set at " +
              double_quoted(place_of(command, below)) + "\n";
  Words patterns;
  for (const std::string& pattern : patterns_with_value(commands))
    patterns.push_back(pattern.starts_with("*") ? "\"*" + pattern.substr(2) : pattern);
  return text + "            case " + joined_by(patterns, " ") + "\n                set skip yes\n";
}

}  // namespace

std::string bash_completion(std::span<const CommandEntry> commands) {
  std::string arms;
  for (const CommandEntry& command : commands) arms += bash_arm(commands, command);
  return "# Completion for bash, printed by `contort completion bash`.\n"
         "_contort() {\n"
         "  local at=\"\" commands=\"\" options=\"\" word=${COMP_WORDS[COMP_CWORD]} i\n"
         "  COMPREPLY=()\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    case \"$at|${COMP_WORDS[i]}\" in\n" +
         arms_that_walk(commands) +
         "    esac\n"
         "  done\n"
         "  if ((i > COMP_CWORD)); then return; fi\n"
         "  case \"$at\" in\n" +
         arms +
         "  esac\n"
         "  if [[ $word == -* ]]; then commands=$options; fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$commands\" -- \"$word\")\n"
         "}\n"
         "complete -o default -F _contort contort\n";
}

std::string zsh_completion(std::span<const CommandEntry> commands) {
  std::string arms;
  for (const CommandEntry& command : commands) arms += zsh_arm(commands, command);
  return "#compdef contort\n"
         "# Completion for zsh, printed by `contort completion zsh`.\n"
         "_contort() {\n"
         "  local at=\"\"\n"
         "  local -i i\n"
         "  local -a commands options\n"
         "  for ((i = 2; i < CURRENT; i++)); do\n"
         "    case \"$at|${words[i]}\" in\n" +
         arms_that_walk(commands) +
         "    esac\n"
         "  done\n"
         "  if ((i > CURRENT)); then\n"
         "    _files\n"
         "    return\n"
         "  fi\n"
         "  case \"$at\" in\n" +
         arms +
         "  esac\n"
         "  if [[ $PREFIX == -* ]]; then\n"
         "    _describe -o option options\n"
         "  elif ((${#commands})); then\n"
         "    _describe command commands\n"
         "  else\n"
         "    _files\n"
         "  fi\n"
         "}\n"
         "if [[ ${funcstack[1]} == _contort ]]; then _contort \"$@\"; else compdef _contort contort; fi\n";
}

std::string fish_completion(std::span<const CommandEntry> commands) {
  std::string lines;
  for (const CommandEntry& command : commands) lines += fish_lines(commands, command);
  return "# Completion for fish, printed by `contort completion fish`.\n"
         "function __contort_is_at\n"
         "    set -l at \"\"\n"
         "    set -l skip no\n"
         "    for word in (commandline -opc)[2..-1]\n"
         "        if test $skip = yes\n"
         "            set skip no\n"
         "            continue\n"
         "        end\n"
         "        switch \"$at|$word\"\n" +
         fish_walk(commands) +
         "        end\n"
         "    end\n"
         "    test $skip = no; and test \"$at\" = \"$argv[1]\"\n"
         "end\n" +
         lines;
}

}  // namespace contort::cli
