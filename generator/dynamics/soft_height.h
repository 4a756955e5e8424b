// Heights without jolts: an upward acceleration presses on legs that bear.
#pragma once

#include <span>
#include <vector>

namespace contort {

// A moving mean over `window` values to either side, twice; ends go on as they are.
void smooth_twice(int window, std::vector<double>& values);

// Heights by frame, m, which are nowhere above the given ones, and differ from them only within 0.4 s of jolts: there
// they are a moving mean. Frames that must keep theirs (`kept` not 0), such as those in flight, keep those beside them
// as well.
std::vector<double> without_jolts(std::span<const double> heights_m, std::span<const char> kept, double rate_hz);

}  // namespace contort
