// Does a stored case still do what it says?
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
  passes,       // nothing is found any more
  refused,      // the spec no longer builds
};
std::string_view verdict_name(Verdict verdict);

struct Replay {
  Verdict verdict = Verdict::refused;
  int first_difference = -1;       // first frame that differs from the stored trace; -1 where none does
  bool character_changed = false;  // the parts or their own actions are not what they were when the case was stored
  Expectation now;                 // of the expected family where it is found, else of the first finding
  Issue issue;                     // for `refused`
};

using RunCase = std::function<Replay(const Case&)>;

// In a scope below the whole the motion is another by nature: `same_family` is the best that it can be. A case that
// ended its process (is_abnormal_exit) is run in a child process first, within the limits that it says, else those of
// `isolation`: the caller has one thread then.
Replay replay(const Case& stored, Evaluator& evaluator, const ReplayScope& scope = {},
              const Isolation& isolation = {});

// Does `work`, which may end its process, in a child, and compares that with the stored ending: `same` where it ends as
// stored, `different` where it ends otherwise. Where it finishes, what it returns here once more.
Replay replay_ending(const Case& stored, const std::function<Replay()>& work, const Isolation& isolation);

}  // namespace contort
