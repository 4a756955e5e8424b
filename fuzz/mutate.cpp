#include "fuzz/mutate.h"

#include <span>

namespace contort {

namespace {

template <class T>
T& one_of(std::vector<T>& list, Dice& dice) {
  return list[static_cast<std::size_t>(dice.below(static_cast<int>(list.size())))];
}

template <class List>
int& one_number(List& numbers, Dice& dice) {
  return numbers[static_cast<std::size_t>(dice.below(static_cast<int>(numbers.size())))];
}

// Picks a clip of a sequence, sometimes of an interrupt's sequence.
RawClip* one_clip(RawSpec& raw, Dice& dice) {
  const bool interrupts = !raw.interrupts.empty() && dice.one_in(5);
  if (!interrupts && raw.sequences.empty()) return nullptr;
  std::vector<RawClip>& clips = interrupts ? one_of(raw.interrupts, dice).clips : one_of(raw.sequences, dice);
  return clips.empty() ? nullptr : &one_of(clips, dice);
}

RawAction* one_action(RawSpec& raw, Dice& dice) {
  RawClip* clip = one_clip(raw, dice);
  return clip == nullptr || clip->actions.empty() ? nullptr : &one_of(clip->actions, dice);
}

// Actions read their values from the front, and most use few, so the first ones are chosen most often.
int& one_value(RawAction& action, Dice& dice) {
  const double share = fraction(dice.raw());
  return action.values[static_cast<std::size_t>(share * share * (kRawValues - 1))];
}

int& number_of_action(RawAction& action, Dice& dice) {
  int* const own[] = {&action.slot,  &action.action,   &action.start,    &action.duration,
                      &action.speed, &action.blend_in, &action.blend_out};
  return dice.one_in(2) ? *own[dice.below(7)] : one_value(action, dice);
}

// The start of the interrupt matters most.
int& number_of_interrupt(RawInterrupt& interrupt, Dice& dice) {
  int* const own[] = {&interrupt.what,  &interrupt.what,  &interrupt.event,
                      &interrupt.enter, &interrupt.after, &interrupt.resume};
  return *own[dice.below(6)];
}

int& number_of_scene(RawSpec& raw, Dice& dice) {
  switch (dice.below(7)) {
    case 0: return raw.hold;
    case 1: return raw.interrupted;
    case 2: return raw.obstacle;
    case 3: return one_number(raw.ground, dice);
    case 4: return one_number(raw.parts, dice);
    case 5: return one_number(raw.objects, dice);
    default: return one_number(raw.dynamics, dice);
  }
}

int& number_of_clip(RawClip& clip, Dice& dice) {
  int* const own[] = {&clip.start, &clip.speed, &clip.stretch};
  return *own[dice.below(3)];
}

// Mostly a number of an action, because actions make the motion. A scene without blows or interrupts has unused numbers
// for them; a change to these has no effect and is drawn again (lineage.h).
int& one_number_of(RawSpec& raw, Dice& dice) {
  if (dice.one_in(5)) return number_of_scene(raw, dice);
  if (!raw.interrupts.empty() && dice.one_in(5)) return number_of_interrupt(one_of(raw.interrupts, dice), dice);
  if (RawClip* clip = dice.one_in(6) ? one_clip(raw, dice) : nullptr) return number_of_clip(*clip, dice);
  if (RawAction* action = one_action(raw, dice)) return number_of_action(*action, dice);
  return number_of_scene(raw, dice);
}

// Moves a number by up to one tenth or four tenths of its range, or sets it to an end or to any value.
void move_number(RawSpec& raw, const RawSpec&, Dice& dice) {
  int& number = one_number_of(raw, dice);
  const int reach = dice.one_in(2) ? kLattice / 10 : 4 * kLattice / 10;
  switch (dice.below(8)) {
    case 0: number = 0; break;
    case 1: number = kLattice; break;
    case 2: number = dice.raw(); break;
    default: number = std::clamp(number + dice.below(2 * reach + 1) - reach, 0, kLattice);
  }
}

void copy_action(RawSpec& raw, const RawSpec&, Dice& dice) {
  RawClip* clip = one_clip(raw, dice);
  if (clip == nullptr || clip->actions.empty() || clip->actions.size() >= kMostActions) return;
  RawAction copy = one_of(clip->actions, dice);
  copy.start = dice.raw();
  clip->actions.push_back(copy);
}

void drop_action(RawSpec& raw, const RawSpec&, Dice& dice) {
  RawClip* clip = one_clip(raw, dice);
  if (clip != nullptr && clip->actions.size() > 1)
    clip->actions.erase(clip->actions.begin() + dice.below(static_cast<int>(clip->actions.size())));
}

void take_action(RawSpec& raw, const RawSpec& mate, Dice& dice) {
  RawSpec other = mate;
  RawClip* clip = one_clip(raw, dice);
  const RawAction* action = one_action(other, dice);
  if (clip == nullptr || action == nullptr) return;
  if (clip->actions.size() < kMostActions && dice.one_in(2))
    clip->actions.push_back(*action);
  else if (!clip->actions.empty())
    one_of(clip->actions, dice) = *action;
}

void copy_clip(RawSpec& raw, const RawSpec&, Dice& dice) {
  if (raw.sequences.empty()) return;
  std::vector<RawClip>& clips = one_of(raw.sequences, dice);
  if (clips.empty() || clips.size() >= kMostClips) return;
  const RawClip copy = one_of(clips, dice);
  clips.push_back(copy);
}

void drop_clip(RawSpec& raw, const RawSpec&, Dice& dice) {
  if (raw.sequences.empty()) return;
  std::vector<RawClip>& clips = one_of(raw.sequences, dice);
  if (clips.size() > 1) clips.erase(clips.begin() + dice.below(static_cast<int>(clips.size())));
}

void take_sequence(RawSpec& raw, const RawSpec& mate, Dice& dice) {
  RawSpec other = mate;
  if (other.sequences.empty()) return;
  if (raw.sequences.size() < kMostSequences && dice.one_in(2))
    raw.sequences.push_back(one_of(other.sequences, dice));
  else if (!raw.sequences.empty())
    one_of(raw.sequences, dice) = one_of(other.sequences, dice);
}

void take_scene(RawSpec& raw, const RawSpec& mate, Dice& dice) {
  switch (dice.below(4)) {
    case 0: raw.ground = mate.ground; break;
    case 1: raw.dynamics = mate.dynamics; break;
    case 2: raw.interrupts = mate.interrupts; break;
    default: raw.omitted = 0;
  }
}

using Change = void (*)(RawSpec&, const RawSpec& mate, Dice&);
constexpr Change kChanges[] = {move_number, move_number, move_number, move_number,   move_number, copy_action,
                               drop_action, take_action, copy_clip,   take_sequence, drop_clip,   take_scene};

void perhaps_to_corner(int& number, Dice& dice) {
  if (dice.one_in(4)) number = dice.one_in(2) ? 0 : kLattice;
}

void to_corners(std::span<int> numbers, Dice& dice) {
  for (int& number : numbers) perhaps_to_corner(number, dice);
}

void to_corners(std::vector<RawClip>& clips, Dice& dice) {
  for (RawClip& clip : clips) {
    for (int* number : {&clip.start, &clip.stretch}) perhaps_to_corner(*number, dice);
    for (RawAction& action : clip.actions) {
      to_corners(action.values, dice);
      for (int* number : {&action.start, &action.duration, &action.blend_in, &action.blend_out})
        perhaps_to_corner(*number, dice);
    }
  }
}

template <class T>
void add_up_to(std::size_t most, std::vector<T>& list, std::span<const T> more) {
  for (const T& one : more)
    if (list.size() < most) list.push_back(one);
}

template <class T>
std::span<const T> beyond(std::size_t count, const std::vector<T>& list) {
  return std::span(list).subspan(std::min(count, list.size()));
}

void overlay_sequence(std::vector<RawClip>& clips, const std::vector<RawClip>& mate) {
  const std::size_t both = std::min(clips.size(), mate.size());
  for (std::size_t c = 0; c < both; ++c) add_up_to(kMostActions, clips[c].actions, std::span(mate[c].actions));
  add_up_to(kMostClips, clips, beyond(both, mate));
}

}  // namespace

void overlay(RawSpec& raw, const RawSpec& mate) {
  const std::size_t both = std::min(raw.sequences.size(), mate.sequences.size());
  for (std::size_t s = 0; s < both; ++s) overlay_sequence(raw.sequences[s], mate.sequences[s]);
  add_up_to(kMostSequences, raw.sequences, beyond(both, mate.sequences));
  add_up_to(kMostInterrupts, raw.interrupts, std::span(mate.interrupts));
  for (const std::size_t count : {kLoadCount, kBlowCount})
    raw.dynamics[count] = std::max(raw.dynamics[count], mate.dynamics[count]);
  // The smaller the number, the likelier an interrupt (compose.cpp).
  raw.interrupted = std::min(raw.interrupted, mate.interrupted);
}

void go_to_corners(RawSpec& raw, Dice& dice) {
  for (std::vector<RawClip>& clips : raw.sequences) to_corners(clips, dice);
  for (RawInterrupt& interrupt : raw.interrupts) to_corners(interrupt.clips, dice);
  to_corners(raw.ground, dice);
}

void leave_out(RawSpec& raw, Dice& dice) { raw.omitted = 1 + dice.below(kLattice); }

void mutate(RawSpec& raw, const RawSpec& mate, Dice& dice) {
  for (int changes = 1 + dice.below(3); changes > 0; --changes)
    kChanges[dice.below(static_cast<int>(std::size(kChanges)))](raw, mate, dice);
}

}  // namespace contort
