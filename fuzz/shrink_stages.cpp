#include "fuzz/shrink_stages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "fuzz/ddmin.h"
#include "fuzz/edits.h"
#include "fuzz/spec_field.h"
#include "fuzz/shrink_state.h"
#include "model/core/math.h"

namespace contort {

namespace {

bool is_needless(const ClipDesc& clip) { return clip.actions.empty() && clip.name.empty(); }

// Returns the spec without empty clips and sequences, unless a name of theirs may be needed by an interrupt.
Spec pruned(Spec spec) {
  for (std::size_t s = 0; s < sequence_count(spec); ++s) std::erase_if(sequence_at(spec, s).clips, is_needless);
  std::erase_if(spec.sequences, [](const SequenceDesc& s) { return s.clips.empty() && s.name.empty(); });
  return spec;
}

// Tries without empty clips first, then with them: an empty clip may be needed as a pause.
bool accept_pruned(ShrinkState& state, Spec candidate) {
  return state.accept(pruned(candidate)) || state.accept(std::move(candidate));
}

using UseAt = std::array<int, 3>;  // sequence, clip, action

Spec with_only(const Spec& spec, const std::set<UseAt>& kept) {
  Spec smaller = spec;
  for (std::size_t s = 0; s < sequence_count(smaller); ++s) {
    std::vector<ClipDesc>& clips = sequence_at(smaller, s).clips;
    for (std::size_t c = 0; c < clips.size(); ++c)
      for (std::size_t a = clips[c].actions.size(); a-- > 0;)
        if (!kept.contains({static_cast<int>(s), static_cast<int>(c), static_cast<int>(a)}))
          clips[c].actions.erase(clips[c].actions.begin() + static_cast<std::ptrdiff_t>(a));
  }
  return smaller;
}

template <class Keep>
std::set<UseAt> uses_where(const TrialResult& shown, Keep keep) {
  std::set<UseAt> uses;
  for (const ActionSpan& span : shown.spans)
    if (keep(span)) uses.insert({span.sequence, span.clip, span.action});
  return uses;
}

}  // namespace

void cut_time(ShrinkState& state) {
  const TrialResult& shown = state.shown();
  if (shown.character == nullptr) return;
  const int worst = shown.expect.worst_frame;
  const auto begun = [&](const ActionSpan& s) { return s.first_frame <= worst; };
  const auto moving = [&](const ActionSpan& s) { return begun(s) && s.last_frame >= worst; };
  const auto named = [&](const ActionSpan& s) {
    const std::string& slot = shown.character->parts()[static_cast<std::size_t>(s.part)].slot;
    return moving(s) && shown.expect.subject.find(slot) != std::string::npos;
  };
  for (const std::set<UseAt>& kept : {uses_where(shown, named), uses_where(shown, moving), uses_where(shown, begun)}) {
    Spec candidate = with_only(state.spec(), kept);
    candidate.hold_frames = 0;
    if (accept_pruned(state, std::move(candidate))) return;
  }
}

void try_stock(ShrinkState& state) {
  static const Spec plain;
  Spec candidate = state.spec();
  candidate.character.parts.clear();
  candidate.character.attachments.clear();
  candidate.environment = plain.environment;
  candidate.start = plain.start;
  candidate.dynamics = plain.dynamics;
  candidate.hold_frames = plain.hold_frames;
  state.accept(std::move(candidate));
}

void remove_structure(ShrinkState& state) {
  for (const UnitKind& kind : unit_kinds())
    ddmin([&] { return kind.count(state.spec()); },
          [&](int first, int n) {
            Spec candidate = state.spec();
            kind.remove(candidate, first, n);
            return accept_pruned(state, std::move(candidate));
          });
}

namespace {

bool queue_interrupt(ShrinkState& state, std::size_t which) {
  Spec last = state.spec();
  last.sequences.push_back(last.interrupts[which].sequence);
  last.interrupts.erase(last.interrupts.begin() + static_cast<std::ptrdiff_t>(which));
  Spec alone = last;
  alone.sequences.erase(alone.sequences.begin(), alone.sequences.end() - 1);
  return accept_pruned(state, std::move(alone)) || accept_pruned(state, std::move(last));
}

}  // namespace

void queue_interrupts(ShrinkState& state) {
  for (std::size_t i = 0; i < state.spec().interrupts.size();)
    if (!queue_interrupt(state, i)) ++i;
}

namespace {

// Returns the fields that shrinking may change. A load that is lighter than the default keeps its mass: with a heavier
// one, the figure would fail under something that the original does not ask of it.
std::vector<SpecField> shrinkable_fields(const ShrinkState& state) {
  std::vector<SpecField> places = state.spec_fields(state.spec());
  std::erase_if(places, [](const SpecField& place) {
    return place.pointer.ends_with("/mass_kg") && place.value < place.preset;
  });
  return places;
}

}  // namespace

void reset_fields(ShrinkState& state) {
  std::vector<SpecField> left = shrinkable_fields(state);
  ddmin([&] { return static_cast<int>(left.size()); },
        [&](int first, int n) {
          const auto from = left.begin() + first;
          Spec candidate = state.spec();
          reset_spec_fields(candidate, std::span(&*from, static_cast<std::size_t>(n)));
          if (!state.accept(std::move(candidate))) return false;
          left.erase(from, from + n);
          return true;
        });
}

namespace {

// Lowers one number, counted in steps of its lattice from its default.
class Lowering {
 public:
  Lowering(ShrinkState& state, const SpecField& place) : state_(state), place_(place) {
    const double steps = std::ceil(std::abs(place.value - place.preset) * place.steps_per_unit);
    if (steps < kMostSteps) now_ = static_cast<std::int64_t>(steps);
  }

  // Tries values of two digits first; more digits stay only if no value of two digits fails.
  void run() {
    std::int64_t grain = 1;
    while (100 * grain <= now_) grain *= 10;
    lower(grain);
    if (now_ % grain != 0) lower(1);
  }

 private:
  static constexpr double kMostSteps = 1e12;  // above this, a step is lost in the rounding of a double

  bool set_to(std::int64_t steps) {
    const double way = static_cast<double>(steps) / place_.steps_per_unit;
    Spec candidate = state_.spec();
    const double value = place_.preset + (place_.value < place_.preset ? -way : way);
    set_spec_field(candidate, place_, on_lattice(value, place_.steps_per_unit));
    return state_.accept(std::move(candidate));
  }

  // Bisects. It assumes that if a value one step nearer to the default does not fail, values still nearer do not fail
  // either; the default itself was tried before.
  void lower(std::int64_t grain) {
    const std::int64_t below = (now_ - 1) / grain * grain;
    if (below <= 0 || !set_to(below)) return;
    now_ = below;
    for (std::int64_t refused = 0; now_ - refused > grain;) {
      const std::int64_t middle = (refused + now_) / 2 / grain * grain;
      (set_to(middle) ? now_ : refused) = middle;
    }
  }

  ShrinkState& state_;
  const SpecField& place_;
  std::int64_t now_ = 0;
};

}  // namespace

void lower_numbers(ShrinkState& state) {
  for (const SpecField& place : shrinkable_fields(state))
    if (place.is_number && !state.halted()) Lowering(state, place).run();
}

namespace {

constexpr std::size_t kMostForAllPairs = 8;  // 28 pairs; with more elements, only neighbours are paired

bool reset_two_fields(ShrinkState& state) {
  const std::vector<SpecField> places = shrinkable_fields(state);
  const std::size_t apart = places.size() <= kMostForAllPairs ? places.size() : 2;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = i + 1; j < std::min(i + apart, places.size()); ++j) {
      Spec candidate = state.spec();
      reset_spec_fields(candidate, std::array{places[i], places[j]});
      if (state.accept(std::move(candidate))) return true;
    }
  return false;
}

bool remove_two_units(ShrinkState& state) {
  for (const UnitKind& kind : unit_kinds()) {
    const int count = kind.count(state.spec());
    const int apart = static_cast<std::size_t>(count) <= kMostForAllPairs ? count : 2;
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < std::min(i + apart, count); ++j) {
        Spec candidate = state.spec();
        kind.remove(candidate, j, 1);
        kind.remove(candidate, i, 1);
        if (accept_pruned(state, std::move(candidate))) return true;
      }
  }
  return false;
}

// Merges clips of equal speed into one; start times keep their order. Stretched clips are left alone.
bool merge_clips(ShrinkState& state) {
  for (std::size_t s = 0; s < sequence_count(state.spec()); ++s)
    for (std::size_t c = 1; c < sequence_at(state.spec(), s).clips.size(); ++c) {
      Spec candidate = state.spec();
      std::vector<ClipDesc>& clips = sequence_at(candidate, s).clips;
      ClipDesc &into = clips[c - 1], &from = clips[c];
      if (into.speed != from.speed || into.duration_frames != 0 || from.duration_frames != 0) continue;
      const double later = (from.start_frame - into.start_frame) * from.speed;
      for (ActionUse& use : from.actions) {
        use.start_frame = std::max(0, use.start_frame + static_cast<int>(std::lround(later)));
        into.actions.push_back(use);
      }
      clips.erase(clips.begin() + static_cast<std::ptrdiff_t>(c));
      if (state.accept(std::move(candidate))) return true;
    }
  return false;
}

// Merges two sequences into one that plays both at once.
bool merge_sequences(ShrinkState& state) {
  for (std::size_t s = 1; s < state.spec().sequences.size(); ++s) {
    Spec candidate = state.spec();
    SequenceDesc &into = candidate.sequences[s - 1], &from = candidate.sequences[s];
    if (into.duration_frames != 0 || from.duration_frames != 0) continue;
    into.clips.insert(into.clips.end(), from.clips.begin(), from.clips.end());
    candidate.sequences.erase(candidate.sequences.begin() + static_cast<std::ptrdiff_t>(s));
    if (state.accept(std::move(candidate))) return true;
  }
  return false;
}

}  // namespace

void try_pairs(ShrinkState& state) {
  if (merge_sequences(state) || merge_clips(state) || remove_two_units(state)) return;
  reset_two_fields(state);
}

}  // namespace contort
