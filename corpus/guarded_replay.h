// Replays in another process: a generator that crashes, hangs or eats memory on one stored case ends that alone.
#pragma once

#include <string>

#include "corpus/replay.h"
#include "process/worker_pool.h"

namespace contort {

// One worker, which keeps what `replay` has built from case to case; where a case ends it, another takes its place. The
// caller must have no other threads. A case that was stored as such an ending is up to `replay` (corpus/replay.h).
class GuardedReplay {
 public:
  GuardedReplay(RunCase replay, const WorkerLimits& limits);

  // A case that ends the worker is `different` from what any check has found; `now` says how it ended.
  Replay operator()(const Case& stored);

 private:
  Replay ended(const Case& stored, const WorkerEvent& event) const;

  WorkerLimits limits_;
  WorkerPool pool_;
};

}  // namespace contort
