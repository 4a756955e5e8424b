#include "model/spec/clip.h"

#include <algorithm>

namespace contort {

double natural_length(const ClipDesc& clip) {
  int length = 0;
  for (const ActionUse& use : clip.actions) length = std::max(length, use.start_frame + use.duration_frames);
  return length;
}

// Does not multiply by a scale, because 7 * (29.0 / 7) is more than 29.
double stretched(double natural, int wanted_frames) {
  return wanted_frames > 0 && natural > 0.0 ? wanted_frames : natural;
}

double clip_length(const ClipDesc& clip) { return stretched(natural_length(clip), clip.duration_frames) / clip.speed; }

std::span<const std::string_view> event_names() {
  static constexpr std::string_view kNames[] = {"frame",       "clip_ended", "sequence_ended", "contact",
                                                "aim_reached", "impact",     "near_obstacle",  "ground_steeper"};
  return kNames;
}

}  // namespace contort
