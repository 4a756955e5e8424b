// The result of a replay in plain words.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "cli/measured_values.h"
#include "corpus/bucket.h"
#include "corpus/case.h"
#include "corpus/replay.h"

namespace contort::cli {

// Verdicts on stored cases and failures, for people.
enum class Outcome : std::uint8_t { fails, differs, passes, refused, unsteady };
Outcome outcome_of(Verdict verdict);
std::string outcome_words(Outcome outcome);  // "still fails"

// "2 still fail, 1 passes now"; "" if nothing ran.
std::string tally_text(const std::map<Outcome, int>& outcomes);

// A failure by its headline and its character: "Elbow leaves its range during swing (hero)".
std::string failure_text(const Case& minimal);

// The failure of a case and the result of its replay: "Elbow leaves its range during swing (hero): is at 120°, limit
// 108°, at frame 30". For a refused case, the reason.
std::string case_text(const Case& stored, const Replay& result, MeasuredValues& values);

// The difference between a stored motion and one that still fails, with a comma before it; "" if they are equal, or if
// it fails in another way.
std::string change_text(const Replay& result);

// "new"; "was fixed, now regressed".
std::string state_text(BucketState before, BucketState after);

}  // namespace contort::cli
