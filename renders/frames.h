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

// Without a finding: evenly spaced, with the first and the last frame.
std::vector<int> spread_frames(int frame_count, int tiles = 8);

}  // namespace contort
