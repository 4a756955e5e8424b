// Messages about a wrong command line: the mistake, and the name that was probably meant.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace contort::cli {

// The parser's own sentence; of an unknown command or option with the one that is spelled most alike.
std::string usage_text(const CLI::App& app, int argc, char** argv, const CLI::ParseError& error);

// The command of this name; nullptr where there is none.
const CLI::App* find_command(const CLI::App& app, const std::string& name);

// Names of the commands, or of the long options, of an app: "check, fuzz".
std::string command_names(const CLI::App& app);
std::string option_names(const CLI::App& app);

// For CLI::Option::check: a value that is one of these words; a misspelled one is told the nearest.
std::function<std::string(const std::string&)> one_of(std::vector<std::string> words);

}  // namespace contort::cli
