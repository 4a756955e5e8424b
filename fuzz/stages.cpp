#include "fuzz/stages.h"

#include <algorithm>

#include "fuzz/dice.h"
#include "fuzz/islands.h"
#include "fuzz/mutate.h"

namespace contort {

namespace {

enum StageStream : std::uint64_t { kChoose = 0x73746167ULL, kArrange, kCornerDice };

constexpr int kThrowsForCrowd = 24;  // number of tries to choose singles for a crowd

// The first rounds of an epoch make singles, which its later rounds combine.
constexpr std::array<CaseStage, kEpochRounds> kStages = {CaseStage::single, CaseStage::single, CaseStage::pair,
                                                         CaseStage::crowd,  CaseStage::single, CaseStage::pair,
                                                         CaseStage::pair,   CaseStage::crowd};

std::int64_t round_of(std::int64_t index) { return index / kRound; }

Ingredients::Pair pair_of(std::int64_t a, std::int64_t b) { return {std::min(a, b), std::max(a, b)}; }

bool goes_with(const Ingredients& known, const Lineage& chosen, std::int64_t other) {
  return std::ranges::none_of(chosen, [&](std::int64_t one) {
    return one == other || std::ranges::find(known.failing, pair_of(one, other)) != known.failing.end();
  });
}

RawAction action_of(std::int64_t seed, std::int64_t index) {
  RawSpec raw = draw_raw(seed, index);
  Dice dice(seed, index, kCornerDice);
  if (dice.one_in(2)) go_to_corners(raw, dice);
  return raw.sequences.front().front().actions.front();
}

// A clip at its own speed, not stretched.
RawClip plain_clip(int start, std::vector<RawAction> actions) { return {start, 0, kLattice, std::move(actions)}; }

RawInterrupt drawn_interrupt(Dice& dice, const RawAction& action) {
  RawInterrupt interrupt{dice.raw(), dice.raw(), dice.raw(), dice.raw(), dice.raw(), {}};
  interrupt.clips.push_back(plain_clip(0, {action}));
  return interrupt;
}

// Places an action at random: into the last clip (three of six ways), in a clip behind it, in a sequence behind that,
// or (the last way) in an interrupt.
constexpr int kWays = 6;

void add_action(RawSpec& raw, Dice& dice, RawAction action, int ways) {
  std::vector<RawClip>& clips = raw.sequences.back();
  action.start = dice.raw();
  const int way = dice.below(ways);
  if (way < 3 && clips.back().actions.size() < kMostActions) return clips.back().actions.push_back(action);
  const RawClip clip = plain_clip(dice.one_in(2) ? 0 : dice.raw(), {action});
  if (way == 5 && raw.interrupts.size() < kMostInterrupts)
    return raw.interrupts.push_back(drawn_interrupt(dice, action));
  if (way == 4) return raw.sequences.push_back({clip});
  clips.push_back(clip);
}

}  // namespace

CaseStage planned_stage(std::int64_t index) {
  return kStages[static_cast<std::size_t>(round_of(index) % kEpochRounds)];
}

std::int64_t setting_of(std::int64_t index) {
  const std::int64_t first_round = round_of(index) / kEpochRounds * kEpochRounds;
  return first_round * kRound + std::int64_t{island_of(index)} * kGeneration;
}

Lineage Ingredients::lineage_of(std::int64_t seed, std::int64_t index) const {
  const CaseStage stage = planned_stage(index);
  if (stage == CaseStage::single || setting != setting_of(index) || clean.size() < 2) return {index};
  Dice dice(seed, index, kChoose);
  const std::size_t wanted =
      stage == CaseStage::pair ? 2 : 3 + static_cast<std::size_t>(dice.below(kMostIngredients - 2));
  Lineage chosen;
  for (int throws = 0; throws < kThrowsForCrowd && chosen.size() < wanted; ++throws) {
    const std::int64_t other = clean[static_cast<std::size_t>(dice.below(static_cast<int>(clean.size())))];
    if (goes_with(*this, chosen, other)) chosen.push_back(other);
  }
  if (chosen.size() < 2) return {index};
  std::ranges::sort(chosen);
  chosen.push_back(index);
  return chosen;
}

void Ingredients::learn(const Lineage& lineage, bool is_clean) {
  const std::int64_t index = lineage.back();
  if (setting != setting_of(index)) *this = {setting_of(index), {}, {}};
  const CaseStage stage = stage_of(lineage);
  if (stage == CaseStage::single && is_clean) clean.push_back(index);
  if (stage == CaseStage::pair && !is_clean) failing.push_back({lineage[0], lineage[1]});
}

RawSpec staged_raw(std::int64_t seed, const Lineage& lineage, const Profile& profile) {
  const std::int64_t index = lineage.back();
  RawSpec raw = draw_raw(seed, setting_of(index));
  raw.sequences = {{plain_clip(0, {action_of(seed, lineage.front())})}};
  raw.interrupts.clear();
  raw.interrupted = 0;
  const int ways = profile.interrupts > 0.0 ? kWays : kWays - 1;
  Dice dice(seed, index, kArrange);
  for (std::size_t i = 1; i + 1 < lineage.size(); ++i) add_action(raw, dice, action_of(seed, lineage[i]), ways);
  return raw;
}

}  // namespace contort
