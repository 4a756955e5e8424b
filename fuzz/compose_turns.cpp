#include "fuzz/compose_turns.h"

#include <algorithm>
#include <cmath>

#include "generator/actions/action.h"
#include "generator/timeline/timeline.h"

namespace contort {

namespace {

std::vector<int> parts_of(const Character& character, const ActionUse& use) {
  const int part = character.find_part(use.slot);
  const Part& named = character.parts()[static_cast<std::size_t>(part)];
  const std::optional<Action> action = find_action(character, named, use.action);
  return parts_moved(*action->def, character, part);
}

void take_turns(const Character& character, ClipDesc& clip) {
  std::vector<int> free_from(character.parts().size(), 0);
  for (ActionUse& use : clip.actions) {
    const std::vector<int> parts = parts_of(character, use);
    for (const int part : parts) use.start_frame = std::max(use.start_frame, free_from[static_cast<std::size_t>(part)]);
    for (const int part : parts) free_from[static_cast<std::size_t>(part)] = use.start_frame + use.duration_frames;
  }
}

}  // namespace

void take_turns(const Character& character, SequenceDesc& sequence) {
  int free_from = 0;
  for (ClipDesc& clip : sequence.clips) {
    take_turns(character, clip);
    clip.start_frame = std::max(clip.start_frame, free_from);
    free_from = clip.start_frame + static_cast<int>(std::ceil(clip_length(clip)));
  }
}

}  // namespace contort
