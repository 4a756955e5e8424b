// Other programs, run to their end.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/core/result.h"

namespace contort::server {

struct Ran {
  int code = 0;         // exit code; 128 + signal
  bool killed = false;  // it took too long, or was no longer wanted
  std::string out;      // the end of what it printed, each
  std::string err;
  double cpu_s = 0.0;  // its own, and that of its children that ended before it
};

// Arguments as they are, without a shell. Ends the program after `seconds`, or when `stop` says so; it also ends when
// the thread that calls this does, in whatever way. Code work.no_process.
Result<Ran> run_program(const std::vector<std::string>& command, double seconds, const std::function<bool()>& stop);

}  // namespace contort::server
