// Independent work on several threads, with results by index.
#pragma once

#include <functional>

namespace contort {

// Calls work(worker, index) for every index in [0, count) from `jobs` threads, worker in [0, jobs). While it waits, the
// calling thread calls idle() about ten times a second. Indices are handed out in rising order; none is skipped unless
// `work` throws: then no further index is handed out, and the first exception is thrown again.
void parallel_for(int jobs, int count, const std::function<void(int worker, int index)>& work,
                  const std::function<void()>& idle);

}  // namespace contort
