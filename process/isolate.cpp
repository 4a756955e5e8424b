#include "process/isolate.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "model/core/assert.h"
#include "process/ended.h"
#include "process/kernel.h"

namespace contort {

namespace {

constexpr int kLookEvery_ms = 5;  // time between two checks of the child's memory
constexpr char kEndMark = '.';    // follows the result; a child that leaves early by exit(0) writes none
constexpr char kEndedMark = '!';  // follows the ending of a program that the work needed

// Restores the default handlers, so that a crash ends the child by its signal whatever handlers we or a sanitizer set.
// The parent handles Ctrl-C.
void reset_signals() {
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS, SIGALRM, SIGPIPE, SIGTERM})
    ::signal(number, SIG_DFL);
  ::signal(SIGINT, SIG_IGN);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n > 0) done += static_cast<std::size_t>(n);
    if (n < 0 && errno != EINTR) return;
  }
}

std::string outcome_of(const std::function<std::string()>& work) {
  try {
    return work() + kEndMark;
  } catch (const ProgramEnded& ended) {
    return print_ending(ended.ending()) + kEndedMark;
  }
}

// noexcept: an exception ends the child by SIGABRT and must not unwind into the caller's copy of the stack.
[[noreturn]] void live_as_child(const std::function<std::string()>& work, const Isolation& isolation, int pipe,
                                pid_t parent) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent died before that call
  reset_signals();
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (isolation.silent) ::dup2(::open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
  ::alarm(static_cast<unsigned>(isolation.seconds));  // the kernel's clock ends even a child that hangs
  write_all(pipe, outcome_of(work));
  ::_exit(0);
}

// The output of the child until it ends, or is killed because it takes too much memory.
struct Heard {
  std::string text;
  bool too_large = false;
};

Heard listen(int pipe, pid_t child, std::int64_t most_bytes) {
  Heard heard;
  std::array<char, 1 << 16> block;
  for (;;) {
    pollfd waiting{pipe, POLLIN, 0};
    if (::poll(&waiting, 1, kLookEvery_ms) > 0) {
      const ssize_t n = ::read(pipe, block.data(), block.size());
      if (n == 0) return heard;
      if (n > 0) heard.text.append(block.data(), static_cast<std::size_t>(n));
    }
    if (!heard.too_large && resident_bytes(child) > most_bytes) {
      heard.too_large = true;
      ::kill(child, SIGKILL);
    }
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

Ending ending_of(Heard heard, int status) {
  if (heard.too_large) return {Ending::Kind::memory, "", ""};
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return {Ending::Kind::timeout, "", ""};
  if (WIFSIGNALED(status)) return {Ending::Kind::crash, signal_name(WTERMSIG(status)), ""};
  const char mark = WEXITSTATUS(status) != 0 || heard.text.empty() ? '\0' : heard.text.back();
  if (mark != kEndMark && mark != kEndedMark)
    return {Ending::Kind::crash, "exit " + std::to_string(WEXITSTATUS(status)), ""};
  heard.text.pop_back();
  if (mark == kEndedMark) return parse_ending(heard.text);
  return {Ending::Kind::finished, "", std::move(heard.text)};
}

Issue no_process() {
  return {"isolate.no_process", "", std::string("no child process could be started: ") + std::strerror(errno)};
}

}  // namespace

Result<Ending> isolate(const std::function<std::string()>& work, const Isolation& isolation) {
  CONTORT_ASSERT(isolation.seconds >= 1);
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return no_process();
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) live_as_child(work, isolation, pipe[1], parent);
  ::close(pipe[1]);
  if (child < 0) {
    const Issue issue = no_process();
    ::close(pipe[0]);
    return issue;
  }
  Heard heard = listen(pipe[0], child, isolation.resident_bytes);
  ::close(pipe[0]);
  return ending_of(std::move(heard), wait_for(child));
}

}  // namespace contort
