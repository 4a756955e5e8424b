#include "corpus/lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace contort {

Result<CorpusLock> CorpusLock::wait_for(int file, int how, const std::string& path, const char* code) {
  if (file < 0) return Issue{code, "", "cannot open " + path + ": " + std::strerror(errno)};
  while (::flock(file, how) != 0) {
    if (errno == EINTR) continue;
    const std::string why = std::strerror(errno);
    ::close(file);
    return Issue{code, "", "cannot lock " + path + ": " + why};
  }
  return CorpusLock(file);
}

Result<CorpusLock> CorpusLock::take(const std::string& folder) {
  const std::string path = folder + "/.lock";
  // Opens for writing, although nothing is written, because locks on NFS need it.
  return wait_for(::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666), LOCK_EX, path,
                  "file.unwritable");
}

Result<CorpusLock> CorpusLock::share(const std::string& folder) {
  const std::string path = folder + "/.lock";
  // Opens without blocking: a pipe in place of the file would block for ever.
  return wait_for(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC), LOCK_SH, path,
                  "file.unreadable");
}

CorpusLock::~CorpusLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace contort
