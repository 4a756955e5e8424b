// Runs calls in child processes, so that a call that ends its process loses nothing else.
#pragma once

#include <functional>
#include <vector>

namespace contort {

// Calls work(i) for every i in [0, count), shared among `jobs` child processes. If a call ends its process or takes
// longer than `seconds`, a new process continues with the next call. Meanwhile idle(number of finished calls) is called
// about ten times a second. Returns the ascending indices of calls that did not return. The caller must have only one
// thread; the children end when it ends.
std::vector<int> in_children(int jobs, int count, int seconds, const std::function<void(int)>& work,
                             const std::function<void(int done)>& idle);

}  // namespace contort
