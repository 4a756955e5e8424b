#include "fuzz/edits.h"

#include "generator/actions/action.h"

#include <algorithm>
#include <iterator>

namespace contort {

namespace {

// The sequences of the queue, then those of the interrupts: s counts through both.
std::size_t sequence_count(const Spec& spec) { return spec.sequences.size() + spec.interrupts.size(); }
SequenceDesc& sequence_at(Spec& spec, std::size_t s) {
  const std::size_t queued = spec.sequences.size();
  return s < queued ? spec.sequences[s] : spec.interrupts[s - queued].sequence;
}
const SequenceDesc& sequence_at(const Spec& spec, std::size_t s) { return sequence_at(const_cast<Spec&>(spec), s); }

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

// Removes elements [first, first + count) of a list whose own elements are numbered from `base` on.
template <class List>
void remove_numbered(List& list, int base, int first, int count) {
  const int size = static_cast<int>(list.size());
  const int from = std::clamp(first - base, 0, size);
  const int to = std::clamp(first + count - base, 0, size);
  list.erase(std::next(list.begin(), from), std::next(list.begin(), to));
}

// The same over many lists that are numbered through.
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
    {"interrupts", count_interrupts, remove_interrupts},
    {"sequences", count_sequences, remove_sequences},
    {"clips", count_clips, remove_clips},
    {"actions", count_actions, remove_actions},
    {"impacts", count_impacts, remove_impacts},
    {"loads", count_loads, remove_loads},
    {"attachments", count_attachments, remove_attachments},
    {"swaps", count_swaps, remove_swaps},
    {"params", count_params, remove_params},
};

// The a-th action of the c-th clip of the s-th sequence.
ActionUse& action_at(Spec& spec, std::size_t s, std::size_t c, std::size_t a) {
  return sequence_at(spec, s).clips[c].actions[a];
}

template <class Visit>
void for_places(const Spec& spec, Visit visit) {
  for (std::size_t s = 0; s < sequence_count(spec); ++s)
    for (std::size_t c = 0; c < sequence_at(spec, s).clips.size(); ++c)
      for (std::size_t a = 0; a < sequence_at(spec, s).clips[c].actions.size(); ++a) visit(s, c, a);
}


void add_param_numbers(const Spec& spec, std::size_t s, std::size_t c, std::size_t a, std::vector<NumberRef>& out) {
  for (const auto& [name, value] : sequence_at(spec, s).clips[c].actions[a].params) {
    const std::string key = name;
    if (std::holds_alternative<double>(value))
      out.push_back({[=](Spec& x) -> double& { return std::get<double>(action_at(x, s, c, a).params.at(key)); }, 0.0,
                     steps_per_unit(key)});
    for (int i = 0; std::holds_alternative<Vec3>(value) && i < 3; ++i)
      out.push_back({[=](Spec& x) -> double& { return std::get<Vec3>(action_at(x, s, c, a).params.at(key))[i]; }, 0.0,
                     steps_per_unit(key)});
  }
}

}  // namespace

std::span<const UnitKind> unit_kinds() { return kUnitKinds; }

std::vector<Edit> default_edits(const Spec& spec) {
  static const Spec plain_spec;
  static const SequenceDesc plain_sequence;
  static const ClipDesc plain_clip;
  static const ActionUse plain_use;
  std::vector<Edit> edits;
  edits.push_back([](Spec& x) { x.hold_frames = plain_spec.hold_frames; });
  edits.push_back([](Spec& x) { x.rate_hz = plain_spec.rate_hz; });
  edits.push_back([](Spec& x) { x.start = plain_spec.start; });
  edits.push_back([](Spec& x) { x.environment = plain_spec.environment; });
  edits.push_back([](Spec& x) { x.environment.ground = plain_spec.environment.ground; });
  edits.push_back([](Spec& x) { x.environment.obstacles.clear(); });
  edits.push_back([](Spec& x) { x.dynamics = plain_spec.dynamics; });
  edits.push_back([](Spec& x) { x.dynamics.mode = Mode::tracking; });
  edits.push_back([](Spec& x) { x.dynamics.ticks_per_frame = plain_spec.dynamics.ticks_per_frame; });
  for (std::size_t i = 0; i < spec.dynamics.impacts.size(); ++i)
    edits.push_back([=](Spec& x) {
      if (i < x.dynamics.impacts.size()) x.dynamics.impacts[i].frame = 0;  // an edit before this may have cleared them
    });
  for (std::size_t i = 0; i < spec.interrupts.size(); ++i) {
    edits.push_back([=](Spec& x) { x.interrupts[i].enter = Enter::front; });
    edits.push_back([=](Spec& x) { x.interrupts[i].resume = true; });
    edits.push_back([=](Spec& x) { x.interrupts[i].when = ConditionDesc{}; });
  }
  for (std::size_t s = 0; s < sequence_count(spec); ++s) {
    edits.push_back([=](Spec& x) { sequence_at(x, s).name = plain_sequence.name; });
    edits.push_back([=](Spec& x) { sequence_at(x, s).duration_frames = plain_sequence.duration_frames; });
    for (std::size_t c = 0; c < sequence_at(spec, s).clips.size(); ++c) {
      edits.push_back([=](Spec& x) { sequence_at(x, s).clips[c].name = plain_clip.name; });
      edits.push_back([=](Spec& x) { sequence_at(x, s).clips[c].start_frame = plain_clip.start_frame; });
      edits.push_back([=](Spec& x) { sequence_at(x, s).clips[c].duration_frames = plain_clip.duration_frames; });
      edits.push_back([=](Spec& x) { sequence_at(x, s).clips[c].speed = plain_clip.speed; });
    }
  }
  for_places(spec, [&](std::size_t s, std::size_t c, std::size_t a) {
    edits.push_back([=](Spec& x) { action_at(x, s, c, a).start_frame = plain_use.start_frame; });
    edits.push_back([=](Spec& x) { action_at(x, s, c, a).duration_frames = plain_use.duration_frames; });
    edits.push_back([=](Spec& x) { action_at(x, s, c, a).speed = plain_use.speed; });
    edits.push_back([=](Spec& x) { action_at(x, s, c, a).blend_in_frames = plain_use.blend_in_frames; });
    edits.push_back([=](Spec& x) { action_at(x, s, c, a).blend_out_frames = plain_use.blend_out_frames; });
  });
  return edits;
}

std::vector<NumberRef> numbers_of(const Spec& spec) {
  std::vector<NumberRef> numbers;
  for_places(spec, [&](std::size_t s, std::size_t c, std::size_t a) { add_param_numbers(spec, s, c, a, numbers); });
  for (std::size_t i = 0; i < spec.dynamics.loads.size(); ++i)
    numbers.push_back({[=](Spec& x) -> double& { return x.dynamics.loads[i].mass_kg; }, LoadDesc{}.mass_kg, 2.0});
  for (std::size_t i = 0; i < spec.dynamics.impacts.size(); ++i)
    for (int k = 0; k < 3; ++k)
      numbers.push_back({[=](Spec& x) -> double& { return x.dynamics.impacts[i].impulse_N_s[k]; }, 0.0, 2.0});
  return numbers;
}

}  // namespace contort
