// The end of a program on which some work depends, such as a generator that runs as a program of its own.
#pragma once

#include <exception>
#include <string>

#include "model/core/result.h"
#include "process/isolate.h"

namespace contort {

// A sentence without its full stop: "the program ended: exit 1; it printed: ...". It quotes only the last characters of
// the output, because errors come last.
std::string describe(const Ending& ending, std::size_t most_printed = kMostPrinted);

// Thrown by work when a program that it needs has ended, so that the work has no result. A worker pool and `isolate`
// report it as if the process of the work had ended in the same way.
class ProgramEnded : public std::exception {
 public:
  // `ending` is not `finished`.
  explicit ProgramEnded(Ending ending) : ending_(std::move(ending)), text_(describe(ending_)) {}
  const Ending& ending() const { return ending_; }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  Ending ending_;
  std::string text_;
};

// The result of work that a program does for us; if that program ends, an issue with the code generator.ended.
template <class Work>
auto unless_it_ends(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const ProgramEnded& ended) {
    return Issue{"generator.ended", "", ended.what()};
  }
}

// Prints an ending as one line of text for a socket or shared memory, and parses it. Invalid text gives a crash without
// a signal.
std::string print_ending(const Ending& ending);
Ending parse_ending(const std::string& text);

}  // namespace contort
