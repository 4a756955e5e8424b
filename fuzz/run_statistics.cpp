#include "fuzz/run_statistics.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace contort {

std::string RunStatistics::strategy_of_case(const Lineage& lineage) const {
  if (is_seed(config_, lineage.back())) return "seed";
  return std::string(strategy_name(strategy_of(odds_of(config_.seed, config_.draw.profile), lineage)));
}

namespace {

// A case counts as same or moved only if no family changed.
void add_case(const Comparison& comparison, std::int64_t index, AgainstCounts& counts) {
  if (!comparison.refusal.empty()) {
    if (counts.refused++ == 0) counts.first_refused = index, counts.first_refusal = comparison.refusal;
    return;
  }
  counts.broke += !comparison.broke.empty();
  counts.worse += !comparison.worse.empty();
  counts.mended += !comparison.mended.empty();
  if (!comparison.broke.empty() || !comparison.worse.empty() || !comparison.mended.empty()) return;
  if (!comparison.moved) ++counts.same;
  if (comparison.moved && counts.moved++ == 0)
    counts.first_moved = index, counts.first_moved_frame = comparison.first_difference;
}

}  // namespace

void RunStatistics::count(const EvaluateReport& report, std::int64_t index, bool fails,
                          const std::string& strategy_name) {
  RunRecord& record = state_.record;
  StrategyCount& strategy = record.arms[strategy_name];
  ++record.cases, ++strategy.cases;
  record.frames += report.frames;
  record.discarded += !report.built;
  if (!report.built) count_refusal(report.refusal, index, record.refusals);
  record.failing += fails, strategy.failing += fails;
  for (const std::string& label : report.tested) ++record.tested[label];
  for (const std::string& label : report.unmet) ++record.unmet[label];
  for (const std::string& label : report.not_judged) ++record.not_judged[label];
  add_uses(report.waivers, state_.waivers);
}

// The cases of one epoch of an island are a group. Cases come in order, so the first one begins the group.
void RunStatistics::count_group(std::int64_t index, const std::vector<Family>& counted) {
  std::vector<Family>& shown = state_.groups[static_cast<std::size_t>(island_of(index))].shown;
  if (index == setting_of(index)) shown.clear(), ++state_.record.groups;
  for (const Family& family : counted) {
    const auto at = std::ranges::lower_bound(shown, family);
    if (at != shown.end() && *at == family) continue;
    shown.insert(at, family);
    ++state_.record.families[family].groups;
  }
}

// Counts this failure, and returns true if it is to be processed.
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
    state_.ingredients[island].learn(lineage, report.built && report.broken.empty() && report.unmet.empty());
  else
    state_.islands[island].learn(lineage, report.near, report.broken);
}

std::vector<SettleTask> RunStatistics::add(const RoundCase& one) {
  const EvaluateReport& report = *one.report;
  const std::int64_t index = one.lineage.back();
  const std::string strategy_name = strategy_of_case(one.lineage);
  const std::vector<Family> counted = counted_families(report);
  count(report, index, !counted.empty(), strategy_name);
  if (report.against && state_.record.against) add_case(*report.against, index, *state_.record.against);
  learn(one.lineage, report);
  std::vector<SettleTask> wanted;
  for (std::size_t rank = 0; rank < counted.size(); ++rank)
    if (wants(counted[rank], rank, index, strategy_name))
      wanted.push_back({one.lineage, counted[rank], static_cast<int>(rank), report.motion_hash, one.ends_process, true,
                        report.against ? report.against->base_hash : ""});
  count_group(index, counted);
  return wanted;
}

}  // namespace contort
