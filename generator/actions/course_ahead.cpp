#include "generator/actions/course_ahead.h"

#include <algorithm>

namespace contort {

FramesAhead frames_ahead(const WholeBody& course) {
  FramesAhead ahead;
  ahead.is_bend = course.lowest.has_value();
  auto& frames = ahead.frames;
  Gait gait = course.gait;
  frames.fill(gait.stand(0.0));
  frames[0] = course.frame;
  if (course.lowest) frames[1] = *course.lowest;
  if (course.lowest || !(course.pace.speed > 0.0)) return ahead;
  const double step_s = course.gait_params.cycle_s / static_cast<double>(frames.size() - 2);
  for (std::size_t n = 1; n + 1 < frames.size(); ++n) {
    const double time_s = course.since_s + static_cast<double>(n) * step_s;
    frames[n] = gait.at(course.gait_params, std::min(time_s, course.lasts_s), course.lasts_s);
  }
  return ahead;
}

}  // namespace contort
