// Starts programs. Every program that this project runs beside itself is started here.
#pragma once

#include <string>
#include <vector>

namespace contort {

inline constexpr int kNotStarted = 127;  // exit code of a child that could not become the program, as in shells

// Descriptors that become the program's standard streams; -1 stands for /dev/null.
struct Streams {
  int in = -1;
  int out = -1;
  int err = -1;
};

// Starts a program in a process group of its own, without a shell, with no signal blocked. It is killed when the
// calling thread ends. Returns the process number, or -1 if no process can be started. A program that cannot be run
// ends with kNotStarted. The caller closes its copies of the descriptors.
int launch(const std::vector<std::string>& command, const Streams& streams);

}  // namespace contort
