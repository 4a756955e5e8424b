// queue_gap: a sequence must begin with its first frame, and continue with the frame in which it was cut. The measure
// is the time that is skipped or played twice.
#include <algorithm>
#include <cstdlib>

#include "checks/check.h"

namespace contort {

namespace {

constexpr double kGap_s = 0.001;  // shorter than a frame at any frame rate

// The frame of the sequence's content that should come next, from 0 on; 0 if the sequence has not run before.
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

// If several sequences begin in one frame, as those without length do, the worst one counts.
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
