#include "process/program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "process/launch.h"

namespace contort {

namespace {

constexpr std::size_t kMostText = 1 << 20;  // bytes; only the end of the output is kept
constexpr int kSignalCheck_ms = 50;
constexpr int kFailedInForeground = 3;  // exit code of the command line for an internal error

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  bool open() { return ::pipe2(ends.data(), O_CLOEXEC) == 0; }
  void close_writer() { ::close(ends[1]), ends[1] = -1; }
};

// Returns true if there may be more to read.
bool read_some(int file, std::string& text) {
  char buffer[16384];
  const ssize_t got = ::read(file, buffer, sizeof buffer);
  if (got < 0) return errno == EINTR || errno == EAGAIN;
  if (got == 0) return false;
  text.append(buffer, static_cast<std::size_t>(got));
  if (text.size() > 2 * kMostText) text.erase(0, text.size() - kMostText);
  return true;
}

std::vector<char*> arguments_of(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

Result<ProgramResult> run_program(const std::vector<std::string>& command, double seconds,
                                  const std::function<bool()>& stop) {
  Pipe out, err;
  if (!out.open() || !err.open()) return Issue{"work.no_process", "", "no pipe for a program"};
  const pid_t pid = launch(command, {-1, out.ends[1], err.ends[1]});
  if (pid < 0) return Issue{"work.no_process", "", "cannot start " + command[0]};
  out.close_writer(), err.close_writer();
  ProgramResult ran;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  bool more_out = true, more_err = true;
  while (more_out || more_err) {
    pollfd files[] = {{more_out ? out.ends[0] : -1, POLLIN, 0}, {more_err ? err.ends[0] : -1, POLLIN, 0}};
    ::poll(files, 2, kSignalCheck_ms);
    if (files[0].revents != 0) more_out = read_some(out.ends[0], ran.out);
    if (files[1].revents != 0) more_err = read_some(err.ends[0], ran.err);
    if (ran.killed || (std::chrono::steady_clock::now() < end && !stop())) continue;
    ran.killed = true;
    ::kill(-pid, SIGKILL);
  }
  int status = 0;
  rusage used{};
  while (::wait4(pid, &status, 0, &used) < 0 && errno == EINTR) {
  }
  ran.code = code_of(status);
  if (ran.code == kNotStarted) return Issue{"work.no_process", "", "cannot start " + command[0]};
  ran.cpu_s = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  return ran;
}

Result<int> run_in_foreground(const std::vector<std::string>& command) {
  std::vector<char*> arguments = arguments_of(command);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) return Issue{"render.no_process", "", std::string("cannot start a process: ") + std::strerror(errno)};
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // without us, nothing would wait for its output
    if (::getppid() != parent) ::_exit(kFailedInForeground);
    ::execv(arguments[0], arguments.data());
    std::fprintf(stderr, "contort: render.no_program: cannot start %s: %s\n", arguments[0], std::strerror(errno));
    ::_exit(kFailedInForeground);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : kFailedInForeground;
}

}  // namespace contort
