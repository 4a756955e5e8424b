#include "cli/start.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "cli/commands.h"
#include "process/ended.h"

namespace contort::cli {

namespace {

// A closed stdout is opened read-only, so that writes fail and the error is reported at the end.
void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) {
      const int opened = ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
      if (opened >= 0 && opened != stream) ::dup2(opened, stream), ::close(opened);
    }
}

// Returns true if standard output is a pipe without a reader. poll reports this at any time, while errno may be from an
// earlier write.
bool nobody_reads() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
}

int close_output(int code) {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::ferror(stdout) == 0) return code;
  const int why = errno;
  if (nobody_reads()) return kNobodyReads;
  std::fprintf(stderr, "contort: output.unwritable: the output could not be written to standard output%s%s\n",
               why == 0 ? "" : ": ",
               why == 0       ? ""
               : why == EBADF ? "it is closed"
                              : std::strerror(why));
  return kInternal;
}

int run_guarded(int argc, char** argv, int (*run)(int argc, char** argv)) {
  try {
    return run(argc, argv);
  } catch (const ProgramEnded& ended) {
    std::fprintf(stderr, "contort: generator.ended: %s\n", ended.what());
    return kFindings;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contort: internal error: %s\n", error.what());
    return kInternal;
  }
}

}  // namespace

int run_to_the_end(int argc, char** argv, int (*run)(int argc, char** argv)) {
  open_closed_streams();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit becomes an error to report, like a full disk
  return close_output(run_guarded(argc, argv, run));
}

}  // namespace contort::cli
