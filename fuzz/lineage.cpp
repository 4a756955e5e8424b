#include "fuzz/lineage.h"

#include <algorithm>
#include <utility>

#include "fuzz/compose.h"
#include "fuzz/mutate.h"
#include "fuzz/stages.h"

namespace contort {

namespace {

enum Stream : std::uint64_t { kChoice, kChange };

constexpr int kThrows = 8;  // most tries of one mutation

// docs/internals/search_measurements.md has the effect of these numbers.
constexpr std::uint64_t kMates = 4;    // number of draws that are overlaid on a case
constexpr std::uint64_t kGrounds = 2;  // number of these that may replace the ground of a case on level ground

// The number of cases after which guidance has its whole share. With all of it from the first case on, 3,000 cases
// showed 130 families; uniform draws showed 144 (docs/internals/search_measurements.md).
constexpr double kLearning = 4096.0;

// Mutates until the spec changes. `config` and `generator` give the numbers their meaning.
RawSpec child_of(const RawSpec& parent, const RawSpec& mate, Dice& dice, const DrawConfig& config,
                 Generator& generator) {
  const Spec before = compose(parent, config, generator);
  RawSpec child = parent;
  for (int throws = 0; throws < kThrows && compose(child, config, generator) == before; ++throws) {
    child = parent;
    mutate(child, mate, dice);
  }
  return child;
}

RawSpec overlaid(std::int64_t seed, std::int64_t index, const Profile& profile) {
  RawSpec raw = draw_raw(seed, index);
  for (std::uint64_t i = 1; i <= kMates; ++i) {
    const RawSpec mate = draw_raw(seed, index, i);
    overlay(raw, mate);
    if (i <= kGrounds && is_level(raw.ground, profile)) raw.ground = mate.ground;
  }
  return raw;
}

}  // namespace

std::string_view strategy_name(Strategy strategy) {
  constexpr std::string_view kNames[kStrategies] = {"single", "pair", "crowd", "uniform", "crowded",           "corners",
                                                    "swarm",   "corners_and_swarm", "guided"};
  return kNames[static_cast<std::size_t>(strategy)];
}

bool wants_guidance(const Odds& odds, std::int64_t index) {
  const double learned = std::min(1.0, static_cast<double>(index) / kLearning);
  return Dice(odds.seed, index, kChoice).below(100) < 100.0 * odds.guided * learned;
}

// A share of the cases is drawn uniformly. The others are overlaid with other draws, and may get corner values,
// left-out features, or both.
Strategy unguided(const Odds& odds, std::int64_t index) {
  Dice dice(odds.seed, index, kChoice);
  dice.next();  // skips the number that wants_guidance uses
  if (dice.below(100) < 100.0 * odds.uniform) return Strategy::uniform;
  constexpr std::pair<Strategy, int> kPercent[] = {
      {Strategy::corners, 70}, {Strategy::overlaid, 20}, {Strategy::swarm, 5}};
  int left = dice.below(100);
  for (const auto& [strategy, percent] : kPercent)
    if ((left -= percent) < 0) return strategy;
  return Strategy::corners_and_swarm;
}

Strategy strategy_of(const Odds& odds, const Lineage& lineage) {
  if (odds.staged) return static_cast<Strategy>(stage_of(lineage));
  return lineage.size() > 1 ? Strategy::guided : unguided(odds, lineage.front());
}

RawSpec raw_of(const DrawConfig& config, Generator& generator, std::int64_t seed, const Lineage& lineage) {
  if (config.profile.staged) return staged_raw(seed, lineage, config.profile);
  const std::int64_t drawn = lineage.front();
  const Strategy strategy = unguided(odds_of(seed, config.profile), drawn);
  RawSpec raw = strategy == Strategy::uniform ? draw_raw(seed, drawn) : overlaid(seed, drawn, config.profile);
  Dice dice(seed, drawn, kChange);
  if (strategy == Strategy::corners || strategy == Strategy::corners_and_swarm) go_to_corners(raw, dice);
  if (strategy == Strategy::swarm || strategy == Strategy::corners_and_swarm) leave_out(raw, dice);
  for (std::size_t i = 1; i < lineage.size(); ++i) {
    Dice own(seed, lineage[i], kChange);
    raw = child_of(raw, draw_raw(seed, lineage[i]), own, config, generator);
  }
  return raw;
}

}  // namespace contort
