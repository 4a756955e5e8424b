// stuck: a sequence must leave the queue when its content is over. The measure is the time that it stays longer.
#include <algorithm>

#include "checks/check.h"

namespace contort {

namespace {

constexpr double kLinger_s = 0.05;

}  // namespace

int stuck_subject_count(const Character&) { return 1; }

Subject stuck_subject(const Character&, int) { return {"queue", "s"}; }

void stuck_measure(const CheckInput& in, MarginFold& fold) {
  if (in.intent == nullptr) return;
  std::vector<double> beyond_s(static_cast<std::size_t>(in.motion.frame_count), -kLinger_s);
  for (const QueueSpan& span : in.motion.queue) {
    const int length = in.intent->sequences[static_cast<std::size_t>(span.sequence)].length;
    for (int frame = span.first_frame; frame <= std::min(span.last_frame, in.motion.frame_count - 1); ++frame) {
      const int content = span.first_content + frame - span.first_frame;
      double& most = beyond_s[static_cast<std::size_t>(frame)];
      most = std::max(most, (content - length) / in.motion.rate_hz);
    }
  }
  for (int frame = 0; frame < in.motion.frame_count; ++frame)
    fold.report(0, frame, kLinger_s - beyond_s[static_cast<std::size_t>(frame)]);
}

}  // namespace contort
