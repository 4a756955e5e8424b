// Cases of work that ended its process: a crash, a timeout, too much memory.
#pragma once

#include "corpus/case.h"
#include "process/isolate.h"

namespace contort {

// Makes a case of an abnormal exit (is_abnormal_exit): check and subject name the kind of exit and its limit, the
// depth is 1, and there are no frames or hashes. The work must not have finished normally.
Case ending_case(const Spec& spec, const Ending& ending, const Isolation& isolation = {});

// The limits under which a stored abnormal exit occurred, if the case has them; under other limits it may end
// differently. Else `otherwise`.
Isolation isolation_of(const Expectation& stored, Isolation otherwise);

}  // namespace contort
