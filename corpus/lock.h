// Makes sure that a corpus has one writer at a time, in this process and in others.
#pragma once

#include <string>
#include <utility>

#include "model/core/result.h"

namespace contort {

// Holds DIR/.lock until it is destroyed. The empty file stays, so that folders do not differ. The kernel releases the
// lock when a process ends, however it ends.
class CorpusLock {
 public:
  // Takes the lock and waits for other holders. Code file.unwritable.
  static Result<CorpusLock> take(const std::string& folder);
  // Takes the lock for reading, together with other readers and without writers. A process that holds the lock must
  // not call it. Code file.unreadable if there is no lock file, which means that nobody has ever written.
  static Result<CorpusLock> share(const std::string& folder);
  CorpusLock(CorpusLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  CorpusLock& operator=(CorpusLock&&) = delete;
  ~CorpusLock();

 private:
  explicit CorpusLock(int file) : file_(file) {}
  static Result<CorpusLock> wait_for(int file, int how, const std::string& path, const char* code);
  int file_ = -1;
};

}  // namespace contort
