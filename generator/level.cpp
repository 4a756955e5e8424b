#include "generator/level.h"

#include <algorithm>

namespace contort {

void LevelPlay::begin(const Level& level) {
  level_ = level;
  first_frame_ = last_frame_ = -1;
  is_over_ = false;
}

void LevelPlay::advance(int frame, std::span<const QueueSpan> history) {
  if (level_.sequence < 0 || is_over_) return;
  const auto runs = [&](const QueueSpan& run) { return run.sequence == level_.sequence && run.last_frame >= frame; };
  const auto run = std::ranges::find_if(history, runs);
  if (run == history.end()) {
    is_over_ = has_begun();  // something cut it
    return;
  }
  const int content = run->first_content + frame - run->first_frame;
  if (content < level_.begins) return;
  if (!has_begun()) first_frame_ = frame;
  last_frame_ = frame;
  is_over_ = content >= level_.ends;
}

}  // namespace contort
