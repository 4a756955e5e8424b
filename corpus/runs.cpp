#include "corpus/runs.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "corpus/run_fields.h"
#include "model/core/inside_folder.h"

namespace contort {

namespace fs = std::filesystem;

std::string record_name(const RunRecord& run) {
  if (run.shards == 1) return run.name;
  return run.name + ".shard_" + std::to_string(run.shard) + "_of_" + std::to_string(run.shards);
}

namespace {

std::string path_of(const Corpus& corpus, const RunRecord& run) {
  return corpus.folder() + "/runs/" + record_name(run) + ".json";
}

void add_families(const RunRecord& shard, RunRecord& sum) {
  for (const auto& [family, count] : shard.families) {
    FamilyCount& all = sum.families[family];
    if (all.cases == 0 || count.first_index < all.first_index)
      all.first_index = count.first_index, all.first_arm = count.first_arm;
    all.cases += count.cases, all.groups += count.groups;
    std::vector<std::int64_t> both;
    std::ranges::merge(all.first_indices, count.first_indices, std::back_inserter(both));
    both.resize(std::min(both.size(), static_cast<std::size_t>(sum.shrinks_per_family)));
    all.first_indices = std::move(both);
  }
}

// Returns true if `index` comes before the first one so far.
bool comes_first(std::int64_t index, std::int64_t first) { return index >= 0 && (first < 0 || index < first); }

void add_comparison(const AgainstCounts& shard, AgainstCounts& sum) {
  sum.base = shard.base, sum.build = shard.build;
  sum.same += shard.same, sum.moved += shard.moved, sum.broke += shard.broke;
  sum.worse += shard.worse, sum.mended += shard.mended, sum.refused += shard.refused;
  if (comes_first(shard.first_moved, sum.first_moved))
    sum.first_moved = shard.first_moved, sum.first_moved_frame = shard.first_moved_frame;
  if (comes_first(shard.first_refused, sum.first_refused))
    sum.first_refused = shard.first_refused, sum.first_refusal = shard.first_refusal;
}

}  // namespace

Result<RunRecord> read_run(const std::string& path) {
  const Result<std::string> text = read_beside(path, json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  Result<RunRecord> run = json_fields::read_document<RunRecord>(*text, "run");
  if (run) return run;
  Issue issue = run.issue();
  issue.text = path + ": " + issue.text;
  return issue;
}

RunRecord added_up(const std::vector<RunRecord>& shards) {
  RunRecord sum;
  sum.name = shards.front().name, sum.tool = shards.front().tool;
  sum.shrinks_per_family = shards.front().shrinks_per_family;
  for (const RunRecord& shard : shards) {
    sum.cases += shard.cases, sum.frames += shard.frames, sum.failing += shard.failing;
    sum.groups += shard.groups, sum.discarded += shard.discarded;
    add_refusals(shard.refusals, sum.refusals);
    add_counts(shard.tested, sum.tested);
    add_counts(shard.unmet, sum.unmet);
    add_counts(shard.not_judged, sum.not_judged);
    add_families(shard, sum);
    if (shard.against) {
      if (!sum.against) sum.against.emplace();
      add_comparison(*shard.against, *sum.against);
    }
    for (const auto& [arm, count] : shard.arms) {
      sum.arms[arm].cases += count.cases;
      sum.arms[arm].failing += count.failing;
    }
  }
  return sum;
}

void add_counts(const std::map<std::string, std::int64_t>& from, std::map<std::string, std::int64_t>& to) {
  for (const auto& [label, count] : from) to[label] += count;
}

void drop_run(const Corpus& corpus, const RunRecord& run) {
  std::error_code ignored;
  fs::remove(path_of(corpus, run), ignored);
}

Result<Done> keep_run(const Corpus& corpus, const RunRecord& run) {
  const std::string path = path_of(corpus, run);
  std::error_code error;
  if (fs::exists(path, error))
    if (const Result<RunRecord> present = read_run(path); present && present->cases > run.cases) return Done{};
  return write_inside(corpus.folder() + "/runs", record_name(run) + ".json", json_fields::write_pretty(run));
}

std::vector<RunRecord> runs_of(const Corpus& corpus, std::vector<Issue>& damaged) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(corpus.folder() + "/runs", error))
    if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  std::vector<RunRecord> all;
  for (const std::string& path : paths) {
    Result<RunRecord> run = read_run(path);
    if (run)
      all.push_back(std::move(run).value());
    else
      damaged.push_back(
          {run.issue().code, run.issue().pointer, run.issue().text + "; contort corpus fsck --repair sets it aside"});
  }
  return all;
}

}  // namespace contort
