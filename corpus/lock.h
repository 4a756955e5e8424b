// One writer of a corpus at a time, in this process and in others.
#pragma once

#include <string>
#include <utility>

#include "model/core/result.h"

namespace contort {

// Holds DIR/.lock until it goes. The empty file stays, so that folders do not differ; the kernel lets go of it when a
// process ends, however it ends.
class CorpusLock {
 public:
  // Waits for others; code file.unwritable.
  static Result<CorpusLock> take(const std::string& folder);
  // For reading, beside other readers; nobody writes meanwhile. Not in a process that has taken it. Code file.unreadable:
  // where no lock is, nobody has ever written.
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
