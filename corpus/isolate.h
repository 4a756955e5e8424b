// Work that may crash, hang or eat memory, in a process of its own; and the cases that such ends make.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "corpus/case.h"
#include "model/core/result.h"

namespace contort {

struct Isolation {
  int seconds = 10;                                     // >= 1, of time as people know it
  std::int64_t resident_bytes = std::int64_t{4} << 30;  // what the caller has itself counts too
  bool silent = false;                                  // what it prints on stderr goes nowhere
};

// How the work came to its end.
struct Ending {
  enum class Kind { finished, crash, timeout, memory };
  Kind kind = Kind::finished;
  std::string signal;  // crash: "SIGSEGV"; "exit 1" where it left without a signal
  std::string result;  // finished: what the work returned
  bool operator==(const Ending&) const = default;
};

// Runs the work in a child process and waits for its end; the child never outlives the call, nor the caller. The caller
// has one thread only: what another one holds at that moment is held in the child for ever. Code isolate.no_process.
Result<Ending> isolate(const std::function<std::string()>& work, const Isolation& isolation = {});

// A finding of its own (is_ending): check and subject say what ended, within what limit, depth 1, without frames or
// hashes. Not for what finished.
Case ending_case(const Spec& spec, const Ending& ending, const Isolation& isolation = {});

// The limits in which a stored ending came about, where it says them: in others it may come to another end.
Isolation isolation_of(const Expectation& stored, Isolation otherwise);

}  // namespace contort
