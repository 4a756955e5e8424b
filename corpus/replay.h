// Replays a stored case and compares the result with what the case expects.
#pragma once

#include <functional>
#include <string>

#include "corpus/case.h"
#include "corpus/evaluator.h"
#include "corpus/replay_scope.h"
#include "process/isolate.h"

namespace contort {

enum class Verdict {
  same,         // equal motion, bit by bit, and the expected finding in it
  same_family,  // the motion differs, but it still fails in the same way
  different,    // it fails, but in another way
  passes,       // no finding any more
  refused,      // the spec no longer builds
};
std::string_view verdict_name(Verdict verdict);

struct Replay {
  Verdict verdict = Verdict::refused;
  int first_difference = -1;       // first frame that differs from the stored trace; -1 if none differs
  bool character_changed = false;  // the parts, or users' actions for them, have changed since the case was stored
  Expectation now;                 // the finding of the expected family if there is one, else the first finding
  Issue issue;                     // for `refused`
};

using RunCase = std::function<Replay(const Case&)>;

// Replays a case. If the scope is only a part of the spec, the motion necessarily differs, so `same_family` is the best
// verdict. A case of an abnormal exit (is_abnormal_exit) is first run in a child process, within its stored limits or
// else those of `isolation`; the caller must then have one thread.
Replay replay(const Case& stored, Evaluator& evaluator, const ReplayScope& scope = {},
              const Isolation& isolation = {});

// Runs `work`, which may end its process, in a child process, and compares the ending with the stored one: `same` if
// it ends as stored, `different` if it ends otherwise. If the work finishes, it is run once more here and its result
// returned.
Replay replay_ending(const Case& stored, const std::function<Replay()>& work, const Isolation& isolation);

}  // namespace contort
