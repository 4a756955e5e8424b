// Work that may crash, hang or use too much memory runs in a process of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/core/result.h"

namespace contort {

struct Isolation {
  int seconds = 10;                                     // >= 1, of wall-clock time
  std::int64_t resident_bytes = std::int64_t{4} << 30;  // includes the memory of the caller itself
  bool silent = false;                                  // its output on stderr is dropped
};

inline constexpr std::size_t kMostPrinted = 4000;

// The way in which the work ended.
struct Ending {
  enum class Kind { finished, crash, timeout, memory };
  Kind kind = Kind::finished;
  std::string signal;  // crash: "SIGSEGV"; "exit 1" if it ended without a signal
  std::string result;  // finished: what the work returned
  std::string printed{};  // the last output of a program that ended (ended.h), one line of at most kMostPrinted ASCII characters
  bool operator==(const Ending&) const = default;
};

// Runs the work in a child process and waits for its end; the child never outlives the call, nor the caller. The caller
// must have only one thread, because a lock that another thread holds at that moment would stay locked in the child.
// Code isolate.no_process.
Result<Ending> isolate(const std::function<std::string()>& work, const Isolation& isolation = {});

}  // namespace contort
