// A program that reads lines from its standard input and writes lines to its standard output, such as `contort
// measure`, or a generator with its frames.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "process/isolate.h"
#include "process/worker_pool.h"

namespace contort {

// The destination of a program's standard error: ours, none, or `Ending::printed`.
enum class Messages { shown, dropped, kept };

class LineProgram {
 public:
  static constexpr std::size_t kMostLine = std::size_t{64} << 20;  // bytes; a program that writes more is ended

  // Starts the program at once. It is killed when this object or the calling thread ends. If it cannot be started, the
  // first read_line() reports that. With `listens`, the program may connect to a port of ours on 127.0.0.1
  // (CONTORT_PORT in its environment) and communicate there from then on; its standard output is then kept as a
  // message. The program proves its identity by the secret word CONTORT_TOKEN.
  LineProgram(const std::vector<std::string>& command, const WorkerLimits& limits, Messages messages,
              bool listens = false);
  ~LineProgram();
  LineProgram(const LineProgram&) = delete;
  LineProgram& operator=(const LineProgram&) = delete;

  // Sends the text, which has no line end, and a line end. If the program does not accept it within the time limit or
  // has ended, the next read reports that.
  void send_line(const std::string& text);

  // Waits for a line, with a time limit of its own if `seconds` is not 0. Returns `finished` with the line as the
  // result. Otherwise the program has ended, or exceeded a limit of time or memory and was killed; all further calls
  // return the same ending. `on_wait` is called about ten times a second.
  Ending read_line(const std::function<void()>& on_wait = {}, double seconds = 0.0);

  // Waits for a number of bytes, at most kMostLine, in the same way.
  Ending read_bytes(std::size_t count);

  // Ends the program as if it had crashed, with this text as its signal, and returns the ending.
  Ending end_because(const std::string& words);

  // Keeps a text as if the program had printed it.
  void keep_message(std::string_view text);

  bool has_connected() const { return connection_ >= 0; }
  const std::string& token() const { return token_; }

 private:
  using Take = std::function<bool(std::string& taken)>;

  Ending read(const Take& take, const std::function<void()>& on_wait, double seconds);
  bool take_line(std::string& line);
  int stream() const { return connection_ >= 0 ? connection_ : socket_; }
  bool wait_for_input(int milliseconds);
  void accept_connection();
  bool receive();
  void hear_messages();
  Ending end_as(Ending::Kind kind);

  WorkerLimits limits_;
  int pid_ = -1;
  int socket_ = -1;
  int messages_ = -1;    // the program's standard error
  int listener_ = -1;    // listens until the program has connected
  int connection_ = -1;  // the TCP connection
  std::string token_;
  bool is_stuck_ = false;  // the program did not read its input in time
  std::string received_;
  std::string printed_;
  Ending ending_;  // the ending of the program; `finished` while it runs
};

}  // namespace contort
