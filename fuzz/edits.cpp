#include "fuzz/edits.h"

#include <algorithm>
#include <iterator>

namespace contort {

std::size_t sequence_count(const Spec& spec) { return spec.sequences.size() + spec.interrupts.size(); }
SequenceDesc& sequence_at(Spec& spec, std::size_t s) {
  const std::size_t queued = spec.sequences.size();
  return s < queued ? spec.sequences[s] : spec.interrupts[s - queued].sequence;
}
const SequenceDesc& sequence_at(const Spec& spec, std::size_t s) { return sequence_at(const_cast<Spec&>(spec), s); }

namespace {

template <class Visit>
void for_clips(Spec& spec, Visit visit) {
  for (std::size_t s = 0; s < sequence_count(spec); ++s)
    for (ClipDesc& clip : sequence_at(spec, s).clips) visit(clip);
}

template <class Visit>
void for_actions(Spec& spec, Visit visit) {
  for_clips(spec, [&](ClipDesc& clip) {
    for (ActionUse& use : clip.actions) visit(use);
  });
}

// Removes the elements numbered [first, first + count) from a list whose elements are numbered from `base` on.
template <class List>
void remove_numbered(List& list, int base, int first, int count) {
  const int size = static_cast<int>(list.size());
  const int from = std::clamp(first - base, 0, size);
  const int to = std::clamp(first + count - base, 0, size);
  list.erase(std::next(list.begin(), from), std::next(list.begin(), to));
}

// Removes numbered elements from several lists, whose elements are numbered continuously.
template <class List>
struct Numbering {
  int first;
  int count;
  int base = 0;
  void remove_from(List& list) {
    const int size = static_cast<int>(list.size());
    remove_numbered(list, base, first, count);
    base += size;
  }
};

int count_interrupts(const Spec& spec) { return static_cast<int>(spec.interrupts.size()); }
void remove_interrupts(Spec& spec, int first, int count) { remove_numbered(spec.interrupts, 0, first, count); }

int count_sequences(const Spec& spec) { return static_cast<int>(spec.sequences.size()); }
void remove_sequences(Spec& spec, int first, int count) { remove_numbered(spec.sequences, 0, first, count); }

int count_clips(const Spec& spec) {
  int total = 0;
  for (std::size_t s = 0; s < sequence_count(spec); ++s) total += static_cast<int>(sequence_at(spec, s).clips.size());
  return total;
}
void remove_clips(Spec& spec, int first, int count) {
  Numbering<std::vector<ClipDesc>> numbering{first, count};
  for (std::size_t s = 0; s < sequence_count(spec); ++s) numbering.remove_from(sequence_at(spec, s).clips);
}

int count_actions(const Spec& spec) {
  int total = 0;
  for_clips(const_cast<Spec&>(spec), [&](const ClipDesc& clip) { total += static_cast<int>(clip.actions.size()); });
  return total;
}
void remove_actions(Spec& spec, int first, int count) {
  Numbering<std::vector<ActionUse>> numbering{first, count};
  for_clips(spec, [&](ClipDesc& clip) { numbering.remove_from(clip.actions); });
}

int count_attachments(const Spec& spec) { return static_cast<int>(spec.character.attachments.size()); }
void remove_attachments(Spec& spec, int first, int count) {
  remove_numbered(spec.character.attachments, 0, first, count);
}

int count_impacts(const Spec& spec) { return static_cast<int>(spec.dynamics.impacts.size()); }
void remove_impacts(Spec& spec, int first, int count) { remove_numbered(spec.dynamics.impacts, 0, first, count); }

int count_loads(const Spec& spec) { return static_cast<int>(spec.dynamics.loads.size()); }
void remove_loads(Spec& spec, int first, int count) { remove_numbered(spec.dynamics.loads, 0, first, count); }

int count_obstacles(const Spec& spec) { return static_cast<int>(spec.environment.obstacles.size()); }
void remove_obstacles(Spec& spec, int first, int count) {
  remove_numbered(spec.environment.obstacles, 0, first, count);
}

int count_swaps(const Spec& spec) { return static_cast<int>(spec.character.parts.size()); }
void remove_swaps(Spec& spec, int first, int count) { remove_numbered(spec.character.parts, 0, first, count); }

int count_params(const Spec& spec) {
  int total = 0;
  for_actions(const_cast<Spec&>(spec), [&](const ActionUse& use) { total += static_cast<int>(use.params.size()); });
  return total;
}
void remove_params(Spec& spec, int first, int count) {
  Numbering<std::map<std::string, ParamValue>> numbering{first, count};
  for_actions(spec, [&](ActionUse& use) { numbering.remove_from(use.params); });
}

constexpr UnitKind kUnitKinds[] = {
    {"sequences", count_sequences, remove_sequences},
    {"interrupts", count_interrupts, remove_interrupts},
    {"clips", count_clips, remove_clips},
    {"actions", count_actions, remove_actions},
    {"impacts", count_impacts, remove_impacts},
    {"loads", count_loads, remove_loads},
    {"obstacles", count_obstacles, remove_obstacles},
    {"attachments", count_attachments, remove_attachments},
    {"swaps", count_swaps, remove_swaps},
    {"params", count_params, remove_params},
};

}  // namespace

std::span<const UnitKind> unit_kinds() { return kUnitKinds; }

}  // namespace contort
