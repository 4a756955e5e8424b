#include "process/line_program.h"

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

namespace contort {

namespace {

constexpr int kPoll_ms = 100;
constexpr char kCannotStart[] = "exit 127";  // as of a program that could not be run

bool is_ready(int socket, short events, int milliseconds) {
  pollfd waiting{socket, events, 0};
  return ::poll(&waiting, 1, milliseconds) > 0;
}

std::string ending_of_status(int status) {
  if (WIFSIGNALED(status)) return signal_name(WTERMSIG(status));
  return "exit " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

LineProgram::LineProgram(const std::vector<std::string>& command, const WorkerLimits& limits, bool silent)
    : limits_(limits) {
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0) {
    pid_ = launch(command, {ends[1], ends[1], silent ? -1 : STDERR_FILENO});
    ::close(ends[1]);
    socket_ = ends[0];
  }
  if (pid_ < 0) ending_ = {Ending::Kind::crash, kCannotStart, {}};
}

LineProgram::~LineProgram() {
  if (pid_ >= 0) (void)end_as(Ending::Kind::timeout);  // without waiting for it to end by itself
  if (socket_ >= 0) ::close(socket_);
}

void LineProgram::send_line(const std::string& text) {
  const std::string line = text + "\n";
  const double deadline_s = steady_s() + limits_.seconds;
  for (std::size_t done = 0; pid_ >= 0 && done < line.size();) {
    const ssize_t sent = ::send(socket_, line.data() + done, line.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) done += static_cast<std::size_t>(sent);
    if (sent >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN) return;
    if (is_stuck_ = steady_s() > deadline_s; is_stuck_) return;
    is_ready(socket_, POLLIN | POLLOUT, kPoll_ms);
    if (is_ready(socket_, POLLIN, 0) && !receive()) return;  // it may have to be rid of its output first
  }
}

bool LineProgram::take_line(std::string& line) {
  const std::size_t end = received_.find('\n');
  if (end == std::string::npos) return false;
  line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return true;
}

// False where the program has closed its output or writes without an end.
bool LineProgram::receive() {
  std::array<char, 1 << 16> block;
  const ssize_t got = ::recv(socket_, block.data(), block.size(), MSG_DONTWAIT);
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  received_.append(block.data(), static_cast<std::size_t>(got));
  return got > 0 && received_.size() <= kMostLine;
}

Ending LineProgram::read_line(const std::function<void()>& on_wait, double seconds) {
  const double deadline_s = steady_s() + (seconds > 0.0 ? seconds : limits_.seconds);
  std::string line;
  while (pid_ >= 0) {
    if (take_line(line)) return {Ending::Kind::finished, {}, line};
    if (is_stuck_ || steady_s() > deadline_s) return end_as(Ending::Kind::timeout);
    if (resident_bytes(pid_) > limits_.bytes) return end_as(Ending::Kind::memory);
    if (is_ready(socket_, POLLIN, kPoll_ms) && !receive()) return end_as(Ending::Kind::crash);
    if (on_wait) on_wait();
  }
  return ending_;
}

// A program that crashed has closed its socket a moment before it can be waited for; one that closed it and goes on is
// killed after that moment.
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
  ending_ = {kind, kind == Ending::Kind::crash ? ending_of_status(status) : "", {}};
  return ending_;
}

}  // namespace contort
