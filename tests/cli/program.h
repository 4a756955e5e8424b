// Runs the built contort and captures its output.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <vector>

#include "tests/corpus/temp_folder.h"

namespace contort {

struct Ran {
  int code = -1;  // exit code; 1000 + n where signal n ended it
  std::string out;
  std::string err;
  double cpu_s = 0.0;
  double peak_MB = 0.0;  // resident memory, that of this process at the fork included
};

// A running contort. Its outputs go to files, or standard output to a descriptor; it may also be closed.
class Program {
 public:
  static constexpr int kToFile = -1, kClosed = -2;
  Program(const std::vector<std::string>& arguments, const std::string& folder, int out = kToFile) : folder_(folder) {
    child_ = ::fork();
    if (child_ == 0) exec(arguments, out);
  }
  void send(int signal) const { ::kill(child_, signal); }
  Ran wait() const {
    int status = 0;
    struct rusage used {};
    while (::wait4(child_, &status, 0, &used) < 0 && errno == EINTR) {
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), slurp(folder_ + "/stdout"),
            slurp(folder_ + "/stderr"), seconds(used.ru_utime) + seconds(used.ru_stime),
            static_cast<double>(used.ru_maxrss) / 1024.0};
  }

 private:
  static double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  void redirect(const char* name, int to) const {
    const int file = ::open((folder_ + name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, to);
  }
  [[noreturn]] void exec(const std::vector<std::string>& arguments, int out) const {
    static std::string program = CONTORT_BINARY_DIR "/contort";
    std::vector<char*> argv = {program.data()};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    redirect("/stderr", STDERR_FILENO);  // first: a file that is opened later would get the number of a closed stream
    if (out == kToFile) redirect("/stdout", STDOUT_FILENO);
    if (out == kClosed) ::close(STDOUT_FILENO);
    if (out >= 0) ::dup2(out, STDOUT_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }

  std::string folder_;
  pid_t child_ = -1;
};

inline Ran contort_program(const std::vector<std::string>& arguments) {
  const TempFolder folder;
  return Program(arguments, folder.path()).wait();
}

// `out` as in Program.
inline Ran contort_into(int out, const std::vector<std::string>& arguments) {
  const TempFolder folder;
  return Program(arguments, folder.path(), out).wait();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

inline std::string last_line(const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  return lines.empty() ? "" : lines.back();
}

}  // namespace contort
