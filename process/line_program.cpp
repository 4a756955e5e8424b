#include "process/line_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "process/clock.h"
#include "process/kernel.h"
#include "process/launch.h"
#include "process/loopback.h"

namespace contort {

namespace {

constexpr int kPoll_ms = 100;
constexpr char kCannotStart[] = "exit 127";  // ending of a program that could not be started

bool is_ready(int socket, short events, int milliseconds) {
  pollfd waiting{socket, events, 0};
  return ::poll(&waiting, 1, milliseconds) > 0;
}

std::string ending_of_status(int status) {
  if (WIFSIGNALED(status)) return signal_name(WTERMSIG(status));
  return "exit " + std::to_string(WEXITSTATUS(status));
}

// Replaces all bytes that are not printable ASCII, because a program may print anything, and its last output goes to
// terminals and into files.
std::string legible(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool is_plain = c >= ' ' && c <= '~';
    if (is_plain || out.empty() || out.back() != ' ') out += is_plain ? c : ' ';
  }
  return out;
}

void close_all(std::initializer_list<int> descriptors) {
  for (const int descriptor : descriptors)
    if (descriptor >= 0) ::close(descriptor);
}

std::vector<std::string> with_variables(const std::vector<std::string>& command, int port, const std::string& token) {
  std::vector<std::string> out{"/usr/bin/env", "CONTORT_PORT=" + std::to_string(port), "CONTORT_TOKEN=" + token};
  out.insert(out.end(), command.begin(), command.end());
  return out;
}

}  // namespace

LineProgram::LineProgram(const std::vector<std::string>& command, const WorkerLimits& limits, Messages messages,
                         bool listens)
    : limits_(limits) {
  std::array<int, 2> ends{-1, -1}, errors{-1, -1};
  int port = 0;
  if (listens) listener_ = listen_on_loopback(port), token_ = random_word();
  const bool has_messages = messages != Messages::kept || ::pipe2(errors.data(), O_CLOEXEC) == 0;
  if (has_messages && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0) {
    const int error = messages == Messages::kept ? errors[1] : messages == Messages::shown ? STDERR_FILENO : -1;
    pid_ = launch(listens ? with_variables(command, port, token_) : command, {ends[1], ends[1], error});
  }
  close_all({ends[1], errors[1]});
  socket_ = ends[0], messages_ = errors[0];
  if (messages_ >= 0) ::fcntl(messages_, F_SETFL, O_NONBLOCK);
  if (pid_ < 0) ending_ = {Ending::Kind::crash, kCannotStart, {}};
}

LineProgram::~LineProgram() {
  if (pid_ >= 0) (void)end_as(Ending::Kind::timeout);  // kills it at once
  close_all({socket_, messages_, listener_, connection_});
}

void LineProgram::send_line(const std::string& text) {
  const std::string line = text + "\n";
  const double deadline_s = steady_s() + limits_.seconds;
  for (std::size_t done = 0; pid_ >= 0 && done < line.size();) {
    const ssize_t sent = ::send(stream(), line.data() + done, line.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) done += static_cast<std::size_t>(sent);
    if (sent >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN) return;
    if (is_stuck_ = steady_s() > deadline_s; is_stuck_) return;
    is_ready(stream(), POLLIN | POLLOUT, kPoll_ms);
    hear_messages();
    if (is_ready(stream(), POLLIN, 0) && !receive()) return;  // the program may only read after its output was taken
  }
}

void LineProgram::keep_message(std::string_view text) {
  printed_ += text;
  if (printed_.size() > kMostPrinted) printed_.erase(0, printed_.size() - kMostPrinted);
}

void LineProgram::hear_messages() {
  std::array<char, 1 << 12> block;
  for (ssize_t got = 1; messages_ >= 0 && got > 0;) {
    got = ::read(messages_, block.data(), block.size());
    if (got > 0) keep_message({block.data(), static_cast<std::size_t>(got)});
    if (got == 0) ::close(messages_), messages_ = -1;
  }
  if (connection_ < 0) return;
  while (socket_ >= 0) {
    const ssize_t got = ::recv(socket_, block.data(), block.size(), MSG_DONTWAIT);
    if (got > 0) keep_message({block.data(), static_cast<std::size_t>(got)});
    if (got == 0) ::close(socket_), socket_ = -1;
    if (got <= 0) return;
  }
}

// Returns true if the program's stream has data or was closed.
bool LineProgram::wait_for_input(int milliseconds) {
  std::array<pollfd, 4> waiting{{{stream(), POLLIN, 0}, {listener_, POLLIN, 0}, {messages_, POLLIN, 0}, {-1, 0, 0}}};
  if (connection_ >= 0) waiting[3] = {socket_, POLLIN, 0};
  if (::poll(waiting.data(), waiting.size(), milliseconds) <= 0) return false;
  if (waiting[2].revents != 0 || waiting[3].revents != 0) hear_messages();
  if (waiting[1].revents != 0) return accept_connection(), false;
  return waiting[0].revents != 0;
}

void LineProgram::accept_connection() {
  connection_ = accept_on_loopback(listener_);
  if (connection_ < 0) return;
  ::close(listener_), listener_ = -1;
  keep_message(received_), received_.clear();
}

bool LineProgram::take_line(std::string& line) {
  const std::size_t end = received_.find('\n');
  if (end == std::string::npos) return false;
  line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return true;
}

// Returns false if the program has closed its output, or writes too much without a line end.
bool LineProgram::receive() {
  std::array<char, 1 << 16> block;
  const ssize_t got = ::recv(stream(), block.data(), block.size(), MSG_DONTWAIT);
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  received_.append(block.data(), static_cast<std::size_t>(got));
  return got > 0 && received_.size() <= kMostLine;
}

Ending LineProgram::read(const Take& take, const std::function<void()>& on_wait, double seconds) {
  const double deadline_s = steady_s() + (seconds > 0.0 ? seconds : limits_.seconds);
  std::string taken;
  while (pid_ >= 0) {
    if (take(taken)) return {Ending::Kind::finished, {}, std::move(taken)};
    if (is_stuck_ || steady_s() > deadline_s) return end_as(Ending::Kind::timeout);
    if (resident_bytes(pid_) > limits_.bytes) return end_as(Ending::Kind::memory);
    if (wait_for_input(kPoll_ms) && !receive()) return end_as(Ending::Kind::crash);
    if (on_wait) on_wait();
  }
  return ending_;
}

Ending LineProgram::read_line(const std::function<void()>& on_wait, double seconds) {
  const bool was_connected = has_connected();
  return read(
      [&](std::string& line) {
        if (has_connected() == was_connected) return take_line(line);
        return line.clear(), true;
      },
      on_wait, seconds);
}

Ending LineProgram::read_bytes(std::size_t count) {
  const auto take = [&](std::string& bytes) {
    if (received_.size() < count) return false;
    bytes.assign(received_, 0, count);
    received_.erase(0, count);
    return true;
  };
  return read(take, {}, 0.0);
}

Ending LineProgram::end_because(const std::string& words) {
  if (pid_ < 0) return ending_;
  (void)end_as(Ending::Kind::timeout);
  ending_.kind = Ending::Kind::crash, ending_.signal = words;
  return ending_;
}

// Waits a moment for a program that closed its socket: if it crashed, its end follows at once. If it continues, it is
// killed.
Ending LineProgram::end_as(Ending::Kind kind) {
  int status = 0;
  pid_t waited = 0;
  const double patience_s = steady_s() + (kind == Ending::Kind::crash ? 1.0 : 0.0);
  do {
    waited = ::waitpid(pid_, &status, WNOHANG);
    if (waited == 0) ::usleep(1000);
  } while (waited == 0 && steady_s() < patience_s);
  ::kill(-pid_, SIGKILL);
  while (waited != pid_ && (waited = ::waitpid(pid_, &status, 0)) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  hear_messages();
  ending_ = {kind, kind == Ending::Kind::crash ? ending_of_status(status) : "", {}, legible(printed_)};
  return ending_;
}

}  // namespace contort
