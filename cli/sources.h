// The options of a command line on which motions depend: libraries, and the generator under test. A command that
// repeats a case needs them too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace contort::cli {

struct Sources {
  std::vector<std::string> libraries{};  // --library
  std::string generator{};             // --generator: a program, or "" for the built-in one
  double case_timeout_s = 10.0;        // time limit of that program for one motion
  std::int64_t memory_MB = 4096;       // memory limit of that program

  // The options as arguments of another call of ours.
  std::vector<std::string> arguments() const;
};

}  // namespace contort::cli
