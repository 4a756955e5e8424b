#include "corpus/causes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kHalfDepth = 3.0;  // depth, in scales of the check, that counts half

double weight_of(CheckKind kind) {
  switch (kind) {
    case CheckKind::broken: return 8.0;
    case CheckKind::speed:
    case CheckKind::ground:
    case CheckKind::obstacle: return 3.0;
    default: return 2.0;
  }
}

double ease_of(CauseScope scope) {
  return scope == CauseScope::setting ? 1.0 : scope == CauseScope::alone ? 0.7 : 0.4;
}

bool comes_before(const CauseMember& a, const CauseMember& b) {
  const double depth_a = depth_of(a.minimal.expect), depth_b = depth_of(b.minimal.expect);
  return depth_a != depth_b ? depth_a > depth_b : a.path < b.path;
}

// Members are sorted by depth. Of an even number, the shallower one of the middle counts.
double median_depth(const std::vector<CauseMember>& members) {
  return depth_of(members[members.size() / 2].minimal.expect);
}

std::int64_t most_cases(const std::vector<CauseMember>& members, std::span<const RunRecord> runs) {
  std::int64_t most = 0;
  for (const CauseMember& member : members) {
    std::int64_t cases = 0;
    for (const RunRecord& run : runs)
      if (const auto at = run.families.find(member.bucket.family); at != run.families.end()) cases += at->second.cases;
    most = std::max(most, cases);
  }
  return most;
}

// Names the places in which the check of the deepest member fails.
std::string headline_of(const Cause& cause, const std::vector<CauseMember>& members) {
  const Case& deepest = members.front().minimal;
  std::vector<std::string> subjects;
  for (const CauseMember& member : members)
    if (member.minimal.expect.check == deepest.expect.check) subjects.push_back(member.minimal.expect.subject);
  return cause_headline(cause, deepest.expect.check, subjects, &deepest.spec.environment);
}

CauseRow row_of(const std::string& id, std::vector<CauseMember> members, std::span<const RunRecord> runs) {
  CauseRow row{.id = id};
  std::ranges::sort(members, comes_before);
  std::int64_t of_cases = 0;
  for (const RunRecord& run : runs) of_cases += run.cases;
  // Shrinking may have found a failure that no whole case showed; then the case that was shrunk counts.
  row.cases = std::max(most_cases(members, runs), std::min<std::int64_t>(of_cases, 1));
  const Case& deepest = members.front().minimal;
  const Cause cause = cause_of(deepest);
  row.headline = headline_of(cause, members);
  const double share = of_cases > 0 ? static_cast<double>(row.cases) / static_cast<double>(of_cases) : 1.0;
  row.severity = severity_of(kind_of_check(deepest.expect.check), median_depth(members), cause.scope, share);
  for (const CauseMember& member : members) row.characters.insert(member.bucket.family.character);
  row.members = std::move(members);
  return row;
}

}  // namespace

std::span<const std::string_view> cause_news_names() {
  static constexpr std::array<std::string_view, 4> kNames = {"known", "new", "more often", "rare"};
  return kNames;
}

double severity_of(CheckKind kind, double median_depth, CauseScope scope, double share) {
  const double depth = std::isfinite(median_depth) ? median_depth / (median_depth + kHalfDepth) : 1.0;
  return 100.0 * weight_of(kind) / 8.0 * depth * ease_of(scope) * std::sqrt(std::min(share, 1.0));
}

std::vector<CauseMember> cause_members(const Corpus& corpus, std::vector<Bucket> buckets,
                                       std::vector<Issue>& damaged) {
  std::vector<CauseMember> members;
  for (Bucket& bucket : buckets) {
    Result<Case> minimal = corpus.minimal_of(bucket);  // may read the bucket again
    if (!minimal) {
      damaged.push_back(minimal.issue());
      continue;
    }
    const std::string path = corpus.folder_of(bucket) + "/" + bucket.min;
    members.push_back({std::move(bucket), std::move(minimal).value(), path});
  }
  return members;
}

std::vector<CauseRow> causes_of(std::vector<CauseMember> members, std::span<const RunRecord> runs) {
  std::map<std::string, std::vector<CauseMember>> groups;
  for (CauseMember& member : members) groups[cause_id_of(member.minimal)].push_back(std::move(member));
  std::vector<CauseRow> rows;
  for (auto& [id, group] : groups) rows.push_back(row_of(id, std::move(group), runs));
  std::ranges::stable_sort(rows, std::greater(), &CauseRow::severity);
  return rows;
}

std::set<std::string> cause_ids(std::span<const CauseMember> members) {
  std::set<std::string> ids;
  for (const CauseMember& member : members) ids.insert(cause_id_of(member.minimal));
  return ids;
}

}  // namespace contort
