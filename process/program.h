// Other programs, run to their end.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/core/result.h"

namespace contort {

struct ProgramResult {
  int code = 0;         // exit code; 128 + signal
  bool killed = false;  // it was ended, because it took too long or `stop` asked for that
  std::string out;      // the last output on each stream
  std::string err;
  double cpu_s = 0.0;  // CPU time of the program, and of its children that ended before it
};

// Arguments as they are, without a shell. Ends the program after `seconds`, or when `stop` says so; it also ends when
// the thread that calls this does, in whatever way. Code work.no_process.
Result<ProgramResult> run_program(const std::vector<std::string>& command, double seconds,
                                  const std::function<bool()>& stop);

// Waits for a program that reads and writes where this process does, and gives its exit code; 3 where a signal ended it
// or it could not be started, of which it says why on stderr. It ends when this process does. Code render.no_process.
Result<int> run_in_foreground(const std::vector<std::string>& command);

}  // namespace contort
