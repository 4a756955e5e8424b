#include "corpus/baseline.h"

#include <algorithm>
#include <filesystem>

#include "corpus/causes.h"
#include "corpus/corpus.h"
#include "corpus/lifecycle.h"
#include "corpus/replay.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;

Result<Baseline> from_corpus(const std::string& folder) {
  const Result<Corpus> corpus = Corpus::open(folder);
  if (!corpus) return corpus.issue();
  std::vector<Issue> damaged;
  Baseline known;
  std::vector<Bucket> buckets = corpus->buckets(damaged);
  if (!damaged.empty()) return damaged.front();
  const auto fixed = std::stable_partition(buckets.begin(), buckets.end(), [](const Bucket& bucket) {
    return bucket.state != BucketState::fixed;
  });
  const std::vector<Bucket> gone(fixed, buckets.end());
  buckets.erase(fixed, buckets.end());
  for (const Bucket& bucket : buckets) known.add(bucket.id, bucket.family);
  // A damaged record of a run is not counted here; reports list it.
  std::vector<Issue> of_runs;
  const std::vector<RunRecord> runs = runs_of(*corpus, of_runs);
  for (const RunRecord& run : runs) known.runs.insert(run.name);
  known.seen = group_counts_of(runs);
  for (const Bucket& bucket : gone) known.seen.of_family.erase(bucket.family);
  // A bucket counts as known even if its minimal case is unreadable.
  known.causes = cause_ids(cause_members(*corpus, std::move(buckets), damaged));
  return known;
}

std::string text_in(const Json& entry, const char* name) {
  const auto found = entry.find(name);
  return found != entry.end() && found->is_string() ? found->get<std::string>() : "";
}

// An entry of a replay has the bucket's folder ("joint_range-0123456789ab") and the verdict; an entry of a list has the
// id and the state.
Result<Done> add_entry(const Json& entry, const std::string& pointer, Baseline& known) {
  if (!entry.is_object()) return Issue{"baseline.no_id", pointer, "expected an object with an \"id\" or a \"bucket\""};
  const std::string id = text_in(entry, "id"), folder = text_in(entry, "bucket"), verdict = text_in(entry, "verdict");
  if (!folder.empty()) {
    const bool fails = verdict == verdict_name(Verdict::same) || verdict == verdict_name(Verdict::same_family);
    if (fails) known.add(folder.substr(folder.rfind('-') + 1), parse_family(text_in(entry, "family")));
    return Done{};
  }
  if (id.empty()) return Issue{"baseline.no_id", pointer, "expected an object with an \"id\" or a \"bucket\""};
  if (text_in(entry, "state") == state_name(BucketState::fixed)) return Done{};
  known.add(id, parse_family(text_in(entry, "family")));
  if (const std::string cause = text_in(entry, "cause"); !cause.empty()) known.causes.insert(cause);
  return Done{};
}

Result<Baseline> from_list(const std::string& path, const Json& list) {
  if (!list.is_array())
    return Issue{"baseline.no_list", "", path + ": expected a list as `contort corpus list --json` prints it"};
  Baseline known;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const Result<Done> added = add_entry(list[i], "/" + std::to_string(i), known); !added)
      return Issue{added.issue().code, added.issue().pointer, path + ": " + added.issue().text};
  return known;
}

}  // namespace

void Baseline::add(const std::string& bucket, const std::optional<Family>& family) {
  buckets.insert(bucket);
  if (family) families.insert(*family);
}

Result<Baseline> read_baseline(const std::string& path) {
  if (std::error_code error; std::filesystem::is_directory(path, error)) return from_corpus(path);
  const Result<std::string> text = read_json_file(path, "a corpus, or a list of buckets (JSON)");
  if (!text) return text.issue();
  const Result<Json> list = json_fields::parse_document(*text);
  if (!list) return Issue{list.issue().code, list.issue().pointer, path + ": " + list.issue().text};
  return from_list(path, *list);
}

bool may_be_chance(const Family& family, const GroupCounts& now, const Baseline& known) {
  if (known.seen.groups == 0 || now.groups == 0) return false;
  if (kind_of_check(family.check) == CheckKind::broken && groups_with(family, known.seen) == 0) return false;
  return !is_more_frequent(family, now, known.seen);
}

bool is_gating(const Bucket& bucket, const std::string& today, const Baseline& known, const GroupCounts& now) {
  if (!is_gating(bucket, today) || known.contains(bucket)) return false;
  return bucket.state != BucketState::fresh || !may_be_chance(bucket.family, now, known);
}

std::set<Family> known_families(const std::vector<Bucket>& buckets, const std::string& today, const Baseline& known,
                                const GroupCounts& now) {
  std::set<Family> families = known.families;
  for (const Bucket& bucket : buckets)
    if (bucket.state != BucketState::fixed && !is_gating(bucket, today, known, now)) families.insert(bucket.family);
  return families;
}

namespace {

CauseNews news_of(const CauseRow& row, const Baseline& known, const GroupCounts& now) {
  const auto any = [&](auto&& of_family) {
    return std::ranges::any_of(row.members,
                               [&](const CauseMember& member) { return of_family(member.bucket.family); });
  };
  if (known.causes.contains(row.id))
    return any([&](const Family& family) { return is_more_frequent(family, now, known.seen); }) ? CauseNews::more
                                                                                                : CauseNews::known;
  if (any([&](const Family& family) { return !may_be_chance(family, now, known); })) return CauseNews::fresh;
  return any([&](const Family& family) { return groups_with(family, known.seen) > 0; }) ? CauseNews::known
                                                                                       : CauseNews::rare;
}

}  // namespace

void add(const Baseline& more, Baseline& known) {
  known.buckets.insert(more.buckets.begin(), more.buckets.end());
  known.families.insert(more.families.begin(), more.families.end());
  known.causes.insert(more.causes.begin(), more.causes.end());
  known.runs.insert(more.runs.begin(), more.runs.end());
  add(more.seen, known.seen);
}

void mark_news(std::vector<CauseRow>& rows, const Baseline& known, const GroupCounts& now) {
  for (CauseRow& row : rows) row.news = news_of(row, known, now);
  std::stable_partition(rows.begin(), rows.end(), [](const CauseRow& row) { return is_news(row.news); });
}

}  // namespace contort
