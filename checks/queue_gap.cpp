// queue_gap: a sequence begins with its first frame, and goes on with the one in which it was cut. What is judged is
// how much of it is left out or played twice.
#include <algorithm>
#include <cstdlib>

#include "checks/check.h"

namespace contort {

namespace {

constexpr double kGap_s = 0.001;  // frames are whole: less than one of any film

// The frame of the sequence's own content that comes next, from 0 on; the first where it never ran before.
int next_content(const Motion& motion, std::size_t span) {
  int next = 0;
  for (const QueueSpan& before : std::span(motion.queue).first(span))
    if (before.sequence == motion.queue[span].sequence)
      next = before.first_content + before.last_frame - before.first_frame;
  return next;
}

}  // namespace

int queue_gap_subject_count(const Character&) { return 1; }

Subject queue_gap_subject(const Character&, int) { return {"queue", "s"}; }

// If several begin in one frame, as sequences without length do, the worst counts.
void queue_gap_measure(const CheckInput& in, MarginFold& fold) {
  const std::vector<QueueSpan>& queue = in.motion.queue;
  for (std::size_t i = 0; i < queue.size() && queue[i].first_frame < in.motion.frame_count;) {
    const int frame = queue[i].first_frame;
    int gap = 0;
    for (; i < queue.size() && queue[i].first_frame == frame; ++i)
      gap = std::max(gap, std::abs(queue[i].first_content - next_content(in.motion, i)));
    fold.report(0, frame, kGap_s - gap / in.motion.rate_hz);
  }
}

}  // namespace contort
