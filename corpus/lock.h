// One writer of a corpus at a time, in this process and in others.
#pragma once

#include <string>
#include <utility>

#include "generator/core/result.h"

namespace contort {

// Holds DIR/.lock until it goes. The empty file stays, so that folders do not differ; the kernel lets go of it when a
// process ends, however it ends.
class CorpusLock {
 public:
  // Waits for others; code file.unwritable.
  static Result<CorpusLock> take(const std::string& folder);
  CorpusLock(CorpusLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  CorpusLock& operator=(CorpusLock&&) = delete;
  ~CorpusLock();

 private:
  explicit CorpusLock(int file) : file_(file) {}
  int file_ = -1;
};

}  // namespace contort
