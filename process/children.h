// Work in processes of their own, so that what ends one of them costs nothing else.
#pragma once

#include <functional>
#include <vector>

namespace contort {

// Calls work(i) for every i in [0, count), each of `jobs` child processes a share of them. Where a call ends its
// process or takes longer than `seconds`, a new one goes on behind it. Meanwhile idle(calls that are over) about ten
// times a second. Gives the indices of calls that did not return, ascending. The caller has one thread only; when it
// ends, however it ends, the children do.
std::vector<int> in_children(int jobs, int count, int seconds, const std::function<void(int)>& work,
                             const std::function<void(int done)>& idle);

}  // namespace contort
