#include "fuzz/compose_turns.h"

#include <algorithm>
#include <cmath>

namespace contort {

namespace {

void take_turns(const Character& character, const Offers& offers, ClipDesc& clip) {
  std::vector<int> free_from(character.parts().size(), 0);
  for (ActionUse& use : clip.actions) {
    const std::vector<int>& parts = find_offer(offers, character.find_part(use.slot), use.action)->moves;
    for (const int part : parts) use.start_frame = std::max(use.start_frame, free_from[static_cast<std::size_t>(part)]);
    for (const int part : parts) free_from[static_cast<std::size_t>(part)] = use.start_frame + use.duration_frames;
  }
}

}  // namespace

void take_turns(const Character& character, const Offers& offers, SequenceDesc& sequence) {
  int free_from = 0;
  for (ClipDesc& clip : sequence.clips) {
    take_turns(character, offers, clip);
    clip.start_frame = std::max(clip.start_frame, free_from);
    free_from = clip.start_frame + static_cast<int>(std::ceil(clip_length(clip)));
  }
}

}  // namespace contort
