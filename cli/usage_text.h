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

// The parser's own sentence. For an unknown command or option it adds the one with the most similar spelling.
std::string usage_text(const CLI::App& app, int argc, char** argv, const CLI::ParseError& error);

// The command of this name; nullptr if there is none.
const CLI::App* find_command(const CLI::App& app, const std::string& name);

// Names of the commands, or of the long options, of an app: "check, fuzz".
std::string command_names(const CLI::App& app);
std::string option_names(const CLI::App& app);

// For CLI::Option::check: accepts only these words, and suggests the nearest one for another word.
std::function<std::string(const std::string&)> one_of(std::vector<std::string> words);

}  // namespace contort::cli
