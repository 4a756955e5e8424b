// Cases of work that ended its process: a crash, a timeout, too much memory.
#pragma once

#include "corpus/case.h"
#include "process/isolate.h"

namespace contort {

// A finding of its own (is_abnormal_exit): check and subject say what ended, within what limit, depth 1, without frames
// or hashes. Not for what finished.
Case ending_case(const Spec& spec, const Ending& ending, const Isolation& isolation = {});

// The limits in which a stored ending came about, where it says them: in others it may come to another end.
Isolation isolation_of(const Expectation& stored, Isolation otherwise);

}  // namespace contort
