// Which frames a film strip shows.
#pragma once

#include <vector>

namespace contort {

// For a finding that lasts from `first` to `last` and is deepest at `worst`: these three, the frame before the first (a
// jump is seen only beside what was still good), frames between them, and some before and after, so that one sees how
// the motion got there and what became of it. Ascending, distinct, in [0, frame_count), exactly min(tiles, frame_count)
// of them. Arguments out of order or out of range are pulled into it. With two tiles `worst` and `first` are kept, with
// one tile `worst`.
std::vector<int> choose_frames(int first, int worst, int last, int frame_count, int tiles = 8);

// Without a finding: evenly spaced from `first` on, with the first and the last frame.
std::vector<int> spread_frames(int frame_count, int tiles = 8, int first = 0);

// A few frames to be shown one after the other, again and again.
struct Clip {
  std::vector<int> frames;  // ascending
  int milliseconds_per_frame = 0;
};

// The half second around a frame, or the whole of a shorter motion: at half speed, as two looks a second cannot be
// followed, and about 30 pictures for a second of motion. `rate_hz` is finite and > 0.
Clip choose_clip(int middle, int frame_count, double rate_hz);

}  // namespace contort
