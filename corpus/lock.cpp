#include "corpus/lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace contort {

Result<CorpusLock> CorpusLock::take(const std::string& folder) {
  const std::string path = folder + "/.lock";
  // For writing, although nothing is written: on NFS a lock needs it.
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return Issue{"file.unwritable", "", "cannot write " + path + ": " + std::strerror(errno)};
  while (::flock(file, LOCK_EX) != 0) {
    if (errno == EINTR) continue;
    const std::string why = std::strerror(errno);
    ::close(file);
    return Issue{"file.unwritable", "", "cannot lock " + path + ": " + why};
  }
  return CorpusLock(file);
}

CorpusLock::~CorpusLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace contort
