#include "process/launch.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace contort {

namespace {

// Between fork and exec, in a process that has other threads: nothing but calls to the kernel. It may have children,
// which are of its group and end with it.
[[noreturn]] void become(char* const* arguments, const Streams& streams, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before that call
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
  if (pid > 0) ::setpgid(pid, pid);  // whichever of the two comes first
  return pid;
}

}  // namespace contort
