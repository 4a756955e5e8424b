#include "cli/report_causes.h"

#include <algorithm>
#include <map>
#include <set>

#include "corpus/condition.h"

namespace contort::cli {

namespace {

// Without a baseline, a cause is new if nobody has acknowledged any of its failures.
CauseNews news_without_baseline(const CauseRow& row) {
  const auto is_fresh = [](const CauseMember& member) { return member.bucket.state == BucketState::fresh; };
  return std::ranges::all_of(row.members, is_fresh) ? CauseNews::fresh : CauseNews::known;
}

std::vector<CauseRow> causes_with_news(std::vector<CauseMember> members, const std::vector<RunRecord>& runs,
                                       const Baseline& known, const GroupCounts& now, bool has_baseline) {
  std::vector<CauseRow> rows = causes_of(std::move(members), runs);
  if (has_baseline)
    mark_news(rows, known, now);
  else
    for (CauseRow& row : rows) row.news = news_without_baseline(row);
  return rows;
}

}  // namespace

void add_cause_rows(std::vector<CauseMember> members, const std::vector<RunRecord>& runs, const Baseline& known,
                    const GroupCounts& now, ReportModel& model) {
  std::erase_if(members, [](const CauseMember& member) { return member.bucket.state == BucketState::fixed; });
  std::map<std::string, std::string> headlines;  // by bucket
  for (const CauseRow& row : causes_with_news(std::move(members), runs, known, now, model.has_baseline)) {
    ReportCause& cause = model.causes.emplace_back();
    cause.id = row.id, cause.headline = row.headline;
    cause.severity = row.severity, cause.cases = row.cases;
    cause.news = row.news;
    cause.characters.assign(row.characters.begin(), row.characters.end());
    for (const CauseMember& member : row.members) {
      cause.buckets.push_back(member.bucket.id);
      headlines[member.bucket.id] = row.headline;
    }
    if (!is_abnormal_exit(row.members.front().minimal.expect)) cause.key = folder_name(row.members.front().bucket);
  }
  for (ReportRow& row : model.rows)
    if (const auto at = headlines.find(row.bucket); at != headlines.end()) row.cause = at->second;
}

Result<Done> add_conditions(const Corpus& corpus, const std::vector<CauseMember>& members, ReportModel& model) {
  const Result<std::vector<Condition>> conditions = conditions_of(corpus);
  if (!conditions) return conditions.issue();
  std::set<std::string> specs;
  for (const CauseMember& member : members) specs.insert(spec_id(member.minimal.spec));
  for (const Condition& condition : *conditions)
    for (ReportCause& cause : model.causes)
      if (cause.id == condition.cause && has_rule(condition) && specs.contains(condition.learned_from))
        cause.conditions[condition.character] = condition_text(condition);
  return Done{};
}

}  // namespace contort::cli
