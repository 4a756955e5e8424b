#include "corpus/runs.h"

#include <algorithm>
#include <filesystem>

#include "generator/core/files.h"
#include "generator/core/json_fields.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

using json_fields::Text;

const json_fields::Rule kTotal{.low = 0, .high = 0x1p53};
const json_fields::Rule kLabel{.text = Text::label, .may_be_empty = true};
constexpr std::size_t kMostEntries = 1'000'000;

}  // namespace

template <class V>
void fields(V& v, const FamilyCount*) {
  v.field("cases", &FamilyCount::cases, kTotal, "Cases that showed it.");
  v.field("first_index", &FamilyCount::first_index, kTotal, "The first of them.");
}

template <class V>
void fields(V& v, const ArmCount*) {
  v.field("cases", &ArmCount::cases, kTotal, "Cases that were drawn in this way.");
  v.field("failing", &ArmCount::failing, kTotal, "Of these with at least one finding.");
  v.field("families", &ArmCount::families, kTotal, "Families that it was the first to see.");
}

template <class V>
void fields(V& v, const RunRecord*) {
  v.constant("format", "contort.run/2");
  v.field("name", &RunRecord::name, {.required = true}, "Name of the run.");
  v.field("tool", &RunRecord::tool, kLabel, "Version.");
  v.field("shard", &RunRecord::shard, {.low = 0, .high = 63}, "Which share of the run, from 0.");
  v.field("shards", &RunRecord::shards, {.low = 1, .high = 64}, "Of how many.");
  v.field("cases", &RunRecord::cases, kTotal, "Cases that ran.");
  v.field("frames", &RunRecord::frames, kTotal, "Frames that they had.");
  v.field("failing", &RunRecord::failing, kTotal, "Cases with at least one finding.");
  v.field("discarded", &RunRecord::discarded, kTotal, "Drawn specs that did not build.");
  v.field("tested", &RunRecord::tested, {.low = 0, .high = 0x1p53, .max_count = kMostEntries, .key_text = Text::label},
          "What the cases were made of.");
  v.field("families", &RunRecord::families, {.max_count = kMostEntries, .key_text = Text::prose},
          "Failures, by family.");
  v.field("arms", &RunRecord::arms, {.max_count = 100}, "Ways of drawing.");
}

std::string record_name(const RunRecord& run) {
  if (run.shards == 1) return run.name;
  return run.name + ".shard_" + std::to_string(run.shard) + "_of_" + std::to_string(run.shards);
}

namespace {

Result<RunRecord> read_run(const std::string& path) {
  const Result<std::string> text = read_file(path, json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  Result<RunRecord> run = json_fields::read_document<RunRecord>(*text, "run");
  if (run) return run;
  Issue issue = run.issue();
  issue.text = path + ": " + issue.text;
  return issue;
}

}  // namespace

Result<Done> keep_run(const Corpus& corpus, const RunRecord& run) {
  const std::string path = corpus.folder() + "/runs/" + record_name(run) + ".json";
  std::error_code error;
  if (fs::exists(path, error))
    if (const Result<RunRecord> present = read_run(path); present && present->cases > run.cases) return Done{};
  return write_file(path, json_fields::write_pretty(run));
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
      damaged.push_back(run.issue());
  }
  return all;
}

}  // namespace contort
