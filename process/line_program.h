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

  // The program is started at once and is killed when this object or the calling thread ends. If it cannot be started,
  // the first read_line() says so. With `listens`, it may connect to a port of ours on 127.0.0.1, which it finds as
  // CONTORT_PORT in its environment, and speak there from then on; what it writes to its standard output is then kept
  // as a message. CONTORT_TOKEN is a secret word by which the program is recognised.
  LineProgram(const std::vector<std::string>& command, const WorkerLimits& limits, Messages messages,
              bool listens = false);
  ~LineProgram();
  LineProgram(const LineProgram&) = delete;
  LineProgram& operator=(const LineProgram&) = delete;

  // Sends the text, which has no line end, and a line end. If the program does not take it within the time limit or has
  // ended, the next reading says so.
  void send_line(const std::string& text);

  // Waits for a line, with a time limit of its own if `seconds` is not 0: `finished` with the line as the result.
  // Otherwise the program has ended, or took more time or memory than allowed and was killed; each further call then
  // gives the same ending. `on_wait` is called about ten times a second.
  Ending read_line(const std::function<void()>& on_wait = {}, double seconds = 0.0);

  // Waits for a number of bytes, at most kMostLine, in the same way.
  Ending read_bytes(std::size_t count);

  // Ends the program as if it had crashed, with these words as its signal, and gives the ending.
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
