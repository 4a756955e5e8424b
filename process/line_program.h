// A program that reads lines from its standard input and writes lines to its standard output, such as `contort
// measure`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "process/isolate.h"
#include "process/worker_pool.h"

namespace contort {

class LineProgram {
 public:
  static constexpr std::size_t kMostLine = std::size_t{64} << 20;  // bytes; a program that writes more is ended

  // The program is started at once and is killed when this object or the calling thread ends. With `silent`, its
  // standard error goes nowhere. If it cannot be started, the first read_line() says so.
  LineProgram(const std::vector<std::string>& command, const WorkerLimits& limits, bool silent);
  ~LineProgram();
  LineProgram(const LineProgram&) = delete;
  LineProgram& operator=(const LineProgram&) = delete;

  // Sends the text, which has no line end, and a line end. If the program does not take it within the time limit or has
  // ended, the next read_line() says so.
  void send_line(const std::string& text);

  // Waits for a line, with a time limit of its own if `seconds` is not 0: `finished` with the line as the result.
  // Otherwise the program has ended, or took more time or memory than allowed and was killed; each further call then
  // gives the same ending. `on_wait` is called about ten times a second.
  Ending read_line(const std::function<void()>& on_wait = {}, double seconds = 0.0);

 private:
  bool take_line(std::string& line);
  bool receive();
  Ending end_as(Ending::Kind kind);

  WorkerLimits limits_;
  int pid_ = -1;
  int socket_ = -1;
  bool is_stuck_ = false;  // it did not take what was sent
  std::string received_;
  Ending ending_;  // of the program; `finished` while it runs
};

}  // namespace contort
