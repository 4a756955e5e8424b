#include "renders/frames.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace contort {
namespace {

void insert_sorted(std::vector<int>& frames, int frame) {
  const auto at = std::lower_bound(frames.begin(), frames.end(), frame);
  if (at == frames.end() || *at != frame) frames.insert(at, frame);
}

// Halves the widest gap between chosen frames; of equal gaps the earlier one. A gap inside the finding counts double,
// because the fault is most important. Returns false when all frames from the first to the last chosen one are chosen.
bool halve_widest_gap(std::vector<int>& frames, int first, int last) {
  std::size_t widest = 0;
  std::int64_t widest_score = 0;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    const std::int64_t gap = std::int64_t{frames[i + 1]} - frames[i];
    const bool inside = frames[i] >= first && frames[i + 1] <= last;
    const std::int64_t score = gap < 2 ? 0 : (inside ? 2 * gap : gap);
    if (score > widest_score) {
      widest = i;
      widest_score = score;
    }
  }
  if (widest_score == 0) return false;
  insert_sorted(frames, frames[widest] + (frames[widest + 1] - frames[widest]) / 2);
  return true;
}

}  // namespace

std::vector<int> choose_frames(int first, int worst, int last, int frame_count, int tiles) {
  if (frame_count <= 0 || tiles <= 0) return {};
  const int end = frame_count - 1;
  worst = std::clamp(worst, 0, end);
  first = std::clamp(first, 0, worst);
  last = std::clamp(last, worst, end);

  const auto wanted = static_cast<std::size_t>(std::min(tiles, frame_count));
  std::vector<int> frames{worst};
  if (frames.size() < wanted) insert_sorted(frames, first);
  if (frames.size() < wanted) insert_sorted(frames, last);
  // Context on either side: half the finding's length, and at least enough frames to choose from.
  const int context = std::max(tiles, (last - first) / 2);
  if (frames.size() + 2 <= wanted) {
    insert_sorted(frames, std::max(0, first - std::min(first, context)));
    insert_sorted(frames, end - last < context ? end : last + context);
  }
  // A jump is visible only next to the last good frame.
  if (frames.size() < wanted && first > 0) insert_sorted(frames, first - 1);
  while (frames.size() < wanted && halve_widest_gap(frames, first, last)) {
  }
  // Needed only if the context had no room on one side (a finding of one frame at the motion's edge).
  for (int frame = 0; frames.size() < wanted; ++frame) insert_sorted(frames, frame);
  return frames;
}

std::vector<int> spread_frames(int frame_count, int tiles, int first) {
  const int shown = frame_count - first, count = std::min(shown, tiles);
  if (count <= 0) return {};
  if (count == 1) return {first};
  std::vector<int> frames;
  for (int i = 0; i < count; ++i)
    frames.push_back(first + static_cast<int>(std::int64_t{i} * (shown - 1) / (count - 1)));
  return frames;
}

Clip choose_clip(int middle, int frame_count, double rate_hz) {
  constexpr double kHalf_s = 0.25, kPictures_hz = 30.0, kSlower = 2.0;
  const int step = std::max(1, static_cast<int>(std::lround(rate_hz / kPictures_hz)));
  const int half = std::max(1, static_cast<int>(std::lround(kHalf_s * rate_hz / step))) * step;
  Clip clip;
  for (int frame = middle - half; frame <= middle + half; frame += step)
    if (frame >= 0 && frame < frame_count) clip.frames.push_back(frame);
  clip.milliseconds_per_frame = static_cast<int>(std::clamp(1000.0 * kSlower * step / rate_hz, 1.0, 10000.0));
  return clip;
}

}  // namespace contort
