// Heights without jolts: an upward acceleration presses on legs that bear.
#pragma once

#include <span>
#include <vector>

namespace contort {

// A moving mean over `window` values to either side, applied twice; end values are repeated beyond the ends.
void smooth_twice(int window, std::vector<double>& values);

// A smooth curve above values >= 0: around each value it falls to 0 within `reach` frames to either side.
std::vector<double> soft_envelope(int reach, std::span<const double> values);

// Heights by frame, m, nowhere above the given ones, and different only within 0.4 s of jolts, where they are a moving
// mean. Frames that must keep their height (`kept` not 0), such as those in flight, keep the heights of their
// neighbours too.
std::vector<double> without_jolts(std::span<const double> heights_m, std::span<const char> kept, double rate_hz);

}  // namespace contort
