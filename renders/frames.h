// Chooses the frames that a film strip shows.
#pragma once

#include <vector>

namespace contort {

// Chooses frames for a finding that lasts from `first` to `last` and is deepest at `worst`: these three, the frame
// before the first (a jump is visible only next to the last good frame), frames between them, and some before and
// after, for context. They are ascending, distinct, in [0, frame_count), and exactly min(tiles, frame_count). Arguments
// out of order or out of range are clamped. With two tiles `worst` and `first` are kept, with one tile `worst`.
std::vector<int> choose_frames(int first, int worst, int last, int frame_count, int tiles = 8);

// Chooses frames without a finding: evenly spaced from `first` on, including the first and the last frame.
std::vector<int> spread_frames(int frame_count, int tiles = 8, int first = 0);

// A few frames that are shown one after the other in a loop.
struct Clip {
  std::vector<int> frames;  // ascending
  int milliseconds_per_frame = 0;
};

// Chooses the half second around a frame, or the whole motion if it is shorter. It is shown at half speed, because two
// repetitions per second are too fast to follow, with about 30 pictures for a second of motion. `rate_hz` is finite and
// > 0.
Clip choose_clip(int middle, int frame_count, double rate_hz);

}  // namespace contort
