#include "generator/additive.h"

#include <algorithm>

namespace contort {

namespace {

constexpr double kCutFade_s = 0.15;

// Returns true if the action has begun in the run and is not over; a cut run goes on while it fades.
bool is_on(const Playback& playback, const PlannedAction& action, const QueueSpan& run) {
  const int frame = playback.frame();
  const bool over = frame > run.last_frame && Playback::content(run, run.last_frame) >= action.last_frame;
  const bool begun = Playback::content(run, std::min(frame, run.last_frame)) >= action.first_frame;
  return !over && begun && playback.content(run) <= action.last_frame;
}

}  // namespace

int cut_fade_frames(double rate_hz) { return std::max(1, static_cast<int>(kCutFade_s * rate_hz)); }

std::optional<double> additive_weight(const Playback& playback, const PlannedAction& action, const QueueSpan& run) {
  if (!is_on(playback, action, run)) return std::nullopt;
  const int frame = playback.frame(), fade = cut_fade_frames(playback.rate_hz());
  double weight = blended_in(action, action.start, playback.content(run)) *
                  not_blended_out(action, playback.content(run));
  if (frame > run.last_frame) weight *= 1.0 - ease(static_cast<double>(frame - run.last_frame) / fade);
  if (run.first_content > action.first_frame) weight *= ease(static_cast<double>(frame - run.first_frame) / fade);
  return weight;
}

}  // namespace contort
