#include "corpus/merge.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "corpus/condition.h"
#include "corpus/leads.h"

namespace contort {

namespace {

using RunsByName = std::map<std::string, std::vector<RunRecord>>;

// Copies a bucket with its state and cases from one corpus to another.
Result<Done> take_bucket(const Corpus& from, const Bucket& bucket, const Corpus& into, Merged& merged) {
  const Result<Done> taken = into.take(from, bucket);
  if (!taken && taken.issue().code == "file.unwritable") return taken;
  if (!taken) merged.damaged.push_back(taken.issue());
  return Done{};
}

// If both corpora have a lead, the shrunk one stays.
Result<Done> take_leads(const Corpus& from, const Corpus& into, Merged& merged) {
  for (const Lead& lead : leads_of(from, merged.damaged)) {
    const Result<Lead> present = read_lead(lead_path(into, lead));
    if (present && present->minimal && !lead.minimal) continue;
    const Result<std::string> kept = keep_lead(into, lead);
    if (!kept && !is_untrusted(kept.issue())) return kept.issue();
    if (!kept) merged.damaged.push_back(kept.issue());  // it stays in the source
  }
  return Done{};
}

RunsByName by_name(std::vector<RunRecord> records) {
  RunsByName runs;
  for (RunRecord& record : records) runs[record.name].push_back(std::move(record));
  return runs;
}

bool is_whole(const RunRecord& record) { return record.shards == 1; }

std::vector<int> missing_shards(const std::vector<RunRecord>& shards) {
  std::vector<int> missing;
  for (int i = 0; i < shards.front().shards; ++i)
    if (std::ranges::find(shards, i, &RunRecord::shard) == shards.end()) missing.push_back(i);
  return missing;
}

std::string sentence_of(const std::vector<RunRecord>& shards, const std::vector<int>& missing) {
  std::string text = shards.front().name + ": shards";
  for (const int shard : missing) text += (text.ends_with("shards") ? " " : ", ") + std::to_string(shard);
  return text + " of " + std::to_string(shards.front().shards) + " are missing";
}

// True for leads that an unsharded run would not have shrunk, because earlier ones of the family filled its quota.
// Failures that were found while another one was shrunk belong to the family of that one.
bool came_too_late(const RunRecord& run, const Lead& lead) {
  const Family& shrunk = lead.original.provenance.met_shrinking;
  const auto family = run.families.find(shrunk.empty() ? family_of(lead.original) : shrunk);
  if (family == run.families.end()) return false;
  const std::vector<std::int64_t>& first = family->second.first_indices;
  return std::ssize(first) >= run.shrinks_per_family && lead.original.provenance.index > first.back();
}

// Leads that an unsharded run would not have shrunk: their family is shown by the minimal spec of an earlier failure of
// the same case, or is that spec's own. Leads that were found while such a failure was shrunk are skipped too. Expects
// leads in the order of cases, and of the failures of each case.
class ToldAlready {
 public:
  bool operator()(const Lead& lead) {
    const Provenance& from = lead.original.provenance;
    if (from.index != index_) index_ = from.index, shown_.clear(), told_.clear();
    if (!from.met_shrinking.empty()) return told_.contains(from.met_shrinking);
    if (shown_.contains(family_of(lead.original))) return told_.insert(family_of(lead.original)), true;
    shown_.merge(families_told_by(lead));
    return false;
  }

 private:
  std::int64_t index_ = -1;
  std::set<Family> shown_, told_;  // families of the present case
};

std::vector<Lead> shrunk_leads_of(const Corpus& corpus, const RunRecord& run, Merged& merged) {
  std::vector<Lead> leads = leads_of(corpus, merged.damaged);
  std::erase_if(leads, [&](const Lead& lead) { return lead.run != run.name || !lead.minimal; });
  std::ranges::stable_sort(leads, {}, [](const Lead& lead) {
    const Provenance& from = lead.original.provenance;
    return std::tuple(from.index, from.rank, !from.met_shrinking.empty());
  });
  return leads;
}

// Files the first leads of each family by index, as one run would have. The record has these indices, because the first
// leads of a shard that is merged again alone need not be the first of the run. Superfluous leads are removed before
// any is filed, so that a kill in between changes nothing.
Result<Done> file_leads(const Corpus& corpus, const RunRecord& run, Merged& merged) {
  std::vector<Lead> to_file, superfluous;
  ToldAlready told_already;
  for (Lead& lead : shrunk_leads_of(corpus, run, merged))
    (came_too_late(run, lead) || told_already(lead) ? superfluous : to_file).push_back(std::move(lead));
  for (const Lead& lead : superfluous) drop_lead(corpus, lead);
  for (const Lead& lead : to_file)
    if (const auto added = file_lead(corpus, lead); !added && is_untrusted(added.issue()))
      merged.damaged.push_back(added.issue());  // it stays a lead: the next merge tries again
    else if (!added)
      return added.issue();
  tidy_leads(corpus, run.name);
  return Done{};
}

// Counts of different splits of one run cannot be added up. Only the shards of the finest split are used.
std::vector<RunRecord> of_one_split(std::vector<RunRecord> shards) {
  int most = 0;
  for (const RunRecord& shard : shards) most = std::max(most, shard.shards);
  std::erase_if(shards, [&](const RunRecord& shard) { return shard.shards != most; });
  return shards;
}

Result<Done> complete_run(const Corpus& corpus, const std::vector<RunRecord>& records, Merged& merged) {
  const auto whole = std::ranges::find_if(records, is_whole);
  RunRecord run;
  if (whole != records.end()) {
    run = *whole;
  } else {
    const std::vector<RunRecord> shards = of_one_split(records);
    if (const std::vector<int> missing = missing_shards(shards); !missing.empty())
      return merged.incomplete.push_back(sentence_of(shards, missing)), Done{};
    run = added_up(shards);
    if (const Result<Done> kept = keep_run(corpus, run); !kept) return kept;
  }
  if (const Result<Done> filed = file_leads(corpus, run, merged); !filed) return filed;
  for (const RunRecord& record : records)  // dropped last, so that after a kill the next merge can start again
    if (!is_whole(record)) drop_run(corpus, record);
  return Done{};
}

// Takes all rules. A rule that was learned from another minimal case is learned again when it is needed.
Result<Done> merge_conditions(const std::vector<Corpus>& sources, const Corpus& into, Merged& merged) {
  std::vector<Condition> more;
  for (const Corpus& corpus : sources)
    if (const Result<std::vector<Condition>> conditions = conditions_of(corpus))
      more.insert(more.end(), conditions->begin(), conditions->end());
    else
      merged.damaged.push_back(conditions.issue());
  if (more.empty()) return Done{};
  const auto changed = change_conditions(into, [&more](std::vector<Condition>& conditions) {
    conditions.insert(conditions.end(), more.begin(), more.end());
    conditions = merged_conditions(std::move(conditions));
  });
  if (!changed && changed.issue().code == "file.unwritable") return changed.issue();
  if (!changed) merged.damaged.push_back(changed.issue());
  return Done{};
}

}  // namespace

Result<Merged> merge(const std::vector<Corpus>& sources, const Corpus& into) {
  Merged merged;
  for (const Corpus& source : sources) {
    if (source.folder() == into.folder()) continue;
    for (const Bucket& bucket : source.buckets(merged.damaged))
      if (const Result<Done> taken = take_bucket(source, bucket, into, merged); !taken) return taken.issue();
    if (const Result<Done> taken = take_leads(source, into, merged); !taken) return taken.issue();
    for (const RunRecord& run : runs_of(source, merged.damaged))
      if (const Result<Done> kept = keep_run(into, run); !kept) return kept.issue();
  }
  for (const auto& [name, records] : by_name(runs_of(into, merged.damaged)))
    if (const Result<Done> completed = complete_run(into, records, merged); !completed) return completed.issue();
  if (const Result<Done> kept = merge_conditions(sources, into, merged); !kept) return kept.issue();
  merged.leads = static_cast<int>(leads_of(into, merged.damaged).size());
  return merged;
}

}  // namespace contort
