#include "fuzz/run_statistics.h"

#include <iterator>
#include <utility>

namespace contort {

std::string RunStatistics::strategy_of_case(const Lineage& lineage) const {
  if (is_seed(config_, lineage.back())) return "seed";
  return std::string(strategy_name(strategy_of(odds_of(config_.seed, config_.draw.profile), lineage)));
}

void RunStatistics::count(const EvaluateReport& report, const std::string& strategy_name) {
  RunRecord& record = state_.record;
  StrategyCount& strategy = record.arms[strategy_name];
  ++record.cases, ++strategy.cases;
  record.frames += report.frames;
  record.discarded += !report.built;
  record.failing += !report.broken.empty(), strategy.failing += !report.broken.empty();
  for (const std::string& label : report.tested) ++record.tested[label];
  add_uses(report.waivers, state_.waivers);
}

// Whether this failure is to be settled. It is counted in any case.
bool RunStatistics::wants(const Family& family, std::size_t rank, std::int64_t index, const std::string& strategy_name) {
  std::map<Family, FamilyCount>& families = state_.record.families;
  FamilyCount& count = families.try_emplace(family, FamilyCount{0, index, {}, strategy_name}).first->second;
  ++count.cases;
  if (std::cmp_greater_equal(rank, config_.shrinks_per_case)) return false;
  if (std::ssize(count.first_indices) >= config_.shrinks_per_family) return false;
  count.first_indices.push_back(index);
  return true;
}

void RunStatistics::learn(const Lineage& lineage, const EvaluateReport& report) {
  if (is_seed(config_, lineage.back())) return;
  const auto island = static_cast<std::size_t>(island_of(lineage.back()));
  if (config_.draw.profile.staged)
    state_.ingredients[island].learn(lineage, report.built && report.broken.empty() && !report.unmet);
  else
    state_.islands[island].learn(lineage, report.near, report.broken);
}

std::vector<SettleTask> RunStatistics::add(const RoundCase& one) {
  const EvaluateReport& report = *one.report;
  const std::int64_t index = one.lineage.back();
  const std::string strategy_name = strategy_of_case(one.lineage);
  count(report, strategy_name);
  learn(one.lineage, report);
  std::vector<SettleTask> wanted;
  for (std::size_t rank = 0; rank < report.broken.size(); ++rank)
    if (wants(report.broken[rank], rank, index, strategy_name))
      wanted.push_back({one.lineage, report.broken[rank], static_cast<int>(rank), report.motion_hash,
                        one.ends_process, true});
  return wanted;
}

}  // namespace contort
