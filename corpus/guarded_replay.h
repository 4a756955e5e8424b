// Replays cases in another process, so that a generator that crashes, hangs or uses too much memory on a stored case
// ends only that process.
#pragma once

#include <string>

#include "corpus/replay.h"
#include "process/worker_pool.h"

namespace contort {

// A worker that keeps the characters that `replay` has built from case to case. If a case ends the worker, another
// one takes its place. The caller must have no other threads. A case that was stored as an abnormal exit is left to
// `replay` (corpus/replay.h).
class GuardedReplay {
 public:
  GuardedReplay(RunCase replay, const WorkerLimits& limits);

  // Replays a case. If the case ends the worker, the verdict is `different`, and `now` describes the ending.
  Replay operator()(const Case& stored);

 private:
  Replay ended(const Case& stored, const WorkerEvent& event) const;

  WorkerLimits limits_;
  WorkerPool pool_;
};

}  // namespace contort
