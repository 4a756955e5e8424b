// The options of a command line that decide which motions there are: libraries, and the generator under test. A command
// that repeats a case needs them too.
#pragma once

#include <string>
#include <vector>

namespace contort::cli {

struct Sources {
  std::vector<std::string> libraries;  // --library
  std::string generator;               // --generator: a program, or "" for the built-in one

  // The options as arguments of another call of ours.
  std::vector<std::string> arguments() const;
};

}  // namespace contort::cli
