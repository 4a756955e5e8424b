#include "process/launch.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace contort {

namespace {

// Runs between fork and exec, in a copy of a process with other threads, so it may only call the kernel. The program
// and its children form a process group, which ends together.
[[noreturn]] void become(char* const* arguments, const Streams& streams, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent died before that call
  ::setpgid(0, 0);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  const auto put = [&](int from, int to) { return ::dup2(from >= 0 ? from : nothing, to) >= 0; };
  if (put(streams.in, 0) && put(streams.out, 1) && put(streams.err, 2)) ::execv(arguments[0], arguments);
  ::_exit(kNotStarted);
}

}  // namespace

int launch(const std::vector<std::string>& command, const Streams& streams) {
  std::vector<char*> arguments;
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) become(arguments.data(), streams, parent);
  if (pid > 0) ::setpgid(pid, pid);  // both processes set the group, because either may run first
  return pid;
}

}  // namespace contort
