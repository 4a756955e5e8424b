#include "corpus/search_progress.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace contort {

namespace {

// The shards of one run, in any order.
struct Shards {
  std::vector<RunRecord> records;

  // The estimated number of the run's cases that ran up to this one. If shards are missing, the indices have gaps.
  std::int64_t place_of(std::int64_t index, const RunRecord& sum) const {
    const auto present = static_cast<double>(records.size()) / records.front().shards;
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(static_cast<double>(index) * present) + 1, 1,
                                    std::max<std::int64_t>(1, sum.cases));
  }
};

std::vector<Shards> by_run(std::span<const RunRecord> runs) {
  std::vector<Shards> all;
  std::map<std::string, std::size_t> at;
  for (const RunRecord& run : runs) {
    const auto [place, is_new] = at.try_emplace(run.name, all.size());
    if (is_new) all.emplace_back();
    all[place->second].records.push_back(run);
  }
  return all;
}

struct Sightings {
  std::int64_t cases = 0;
  std::int64_t first = 0;  // number of all cases up to the first sighting
  std::string first_arm;
  std::pair<std::string, std::int64_t> first_case;  // run and index
};

}  // namespace

SearchProgress progress_of(std::span<const RunRecord> runs) {
  SearchProgress all;
  std::map<Family, Sightings> families;
  std::map<std::string, ArmProgress> arms;
  for (const Shards& shards : by_run(runs)) {
    const RunRecord run = added_up(shards.records);
    for (const auto& [name, count] : run.families) {
      const std::int64_t index = count.first_index;
      const Sightings met{0, all.cases + shards.place_of(index, run), count.first_arm, {run.name, index}};
      families.try_emplace(name, met).first->second.cases += count.cases;
    }
    for (const auto& [name, count] : run.arms) arms[name].cases += count.cases, arms[name].failing += count.failing;
    all.cases += run.cases, all.failing += run.failing;
  }
  std::set<std::pair<std::string, std::int64_t>> lone;
  for (const auto& [family, seen] : families) {
    all.discovered.push_back(seen.first);
    if (seen.cases == 1) ++all.met_once, lone.insert(seen.first_case);
    if (const auto arm = arms.find(seen.first_arm); arm != arms.end()) ++arm->second.families;
  }
  all.lone_cases = std::ssize(lone);
  std::ranges::sort(all.discovered);
  for (auto& [name, arm] : arms) arm.name = name, all.arms.push_back(arm);
  return all;
}

double unseen_share(const SearchProgress& progress) {
  if (progress.cases == 0) return 1.0;
  const double events = progress.lone_cases > 0 ? static_cast<double>(progress.lone_cases) : 3.0;
  return std::min(1.0, events / static_cast<double>(progress.cases));
}

}  // namespace contort
