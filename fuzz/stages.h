// The stages of a search: actions alone, pairs of actions that are clean alone, and crowds of them.
//
// The cases of an island come in epochs of kEpochRounds rounds. All cases of an epoch share one setting: a character
// with its parts and objects, the ground, walls, and how the motion is controlled. A single is one action in that
// setting. A pair is made of two singles that were clean, so whatever it shows needs both. A crowd is made of three or
// more of them, and never holds two that failed as a pair. So one defect is reported once, by the smallest case that
// shows it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fuzz/lineage.h"
#include "fuzz/raw.h"

namespace contort {

inline constexpr int kEpochRounds = 8;
inline constexpr std::size_t kMostIngredients = 8;  // the most actions in a crowd

enum class CaseStage { single, pair, crowd };

// Returns the stage of case `index` if there are enough clean singles; otherwise the case is a single.
CaseStage planned_stage(std::int64_t index);
// Returns the stage of a case with these ingredients.
inline CaseStage stage_of(const Lineage& lineage) {
  return lineage.size() == 1 ? CaseStage::single : lineage.size() == 3 ? CaseStage::pair : CaseStage::crowd;
}

// Returns the index of the case whose draw is the setting of case `index`: the first of its epoch on its island.
std::int64_t setting_of(std::int64_t index);

// An island's knowledge of its epoch.
struct Ingredients {
  using Pair = std::array<std::int64_t, 2>;

  // Returns the indices of the singles of which case `index` is made, ascending, and then its own.
  Lineage lineage_of(std::int64_t seed, std::int64_t index) const;
  // Records the result of a case. Must be called in the order of cases.
  void learn(const Lineage& lineage, bool is_clean);

  std::int64_t setting = -1;
  std::vector<std::int64_t> clean;  // singles without a finding and without an unmet request, ascending
  std::vector<Pair> failing;        // pairs of clean singles with a finding, the smaller index first
  bool operator==(const Ingredients&) const = default;
};

// Returns the raw numbers of a case of a staged run. The dice of its own index decide how its actions meet: at the same
// time, one after the other, in sequences of a queue, or by an interrupt.
RawSpec staged_raw(std::int64_t seed, const Lineage& lineage, const Profile& profile);

}  // namespace contort
