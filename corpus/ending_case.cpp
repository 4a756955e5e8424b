#include "corpus/ending_case.h"

#include "model/core/assert.h"

namespace contort {

Case ending_case(const Spec& spec, const Ending& ending, const Isolation& isolation) {
  CONTORT_ASSERT(ending.kind != Ending::Kind::finished);
  Case ended;
  ended.spec = spec;
  const bool crashed = ending.kind == Ending::Kind::crash;
  ended.expect.check = crashed ? "crash" : ending.kind == Ending::Kind::timeout ? "timeout" : "memory";
  ended.expect.subject = crashed ? ending.signal : "evaluation";
  ended.expect.printed = ending.printed;
  ended.expect.worst_margin = -1.0;
  ended.expect.depth = 1.0;
  if (ending.kind == Ending::Kind::timeout) ended.expect.limit_s = isolation.seconds;
  if (ending.kind == Ending::Kind::memory) ended.expect.limit_MB = static_cast<int>(isolation.resident_bytes >> 20);
  return ended;
}

Isolation isolation_of(const Expectation& stored, Isolation otherwise) {
  if (stored.limit_s > 0) otherwise.seconds = stored.limit_s;
  if (stored.limit_MB > 0) otherwise.resident_bytes = std::int64_t{stored.limit_MB} << 20;
  return otherwise;
}

}  // namespace contort
