// Runs other programs to their end.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/core/result.h"

namespace contort {

struct ProgramResult {
  int code = 0;         // exit code; 128 + signal
  bool killed = false;  // true if it was ended because it took too long or `stop` returned true
  std::string out;      // the last output on each stream
  std::string err;
  double cpu_s = 0.0;  // CPU time of the program, and of its children that ended before it
};

// Runs a program without a shell. It is ended after `seconds`, when `stop` returns true, or when the calling thread
// ends. Code work.no_process.
Result<ProgramResult> run_program(const std::vector<std::string>& command, double seconds,
                                  const std::function<bool()>& stop);

// Runs a program that shares the standard streams of this process, and returns its exit code. It returns 3, and prints
// the reason to stderr, if a signal ended the program or it could not be started. The program ends when this process
// does. Code render.no_process.
Result<int> run_in_foreground(const std::vector<std::string>& command);

}  // namespace contort
