#include "corpus/baseline.h"

#include <filesystem>

#include "corpus/corpus.h"
#include "corpus/lifecycle.h"
#include "generator/core/files.h"
#include "generator/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;

Result<Baseline> from_corpus(const std::string& folder) {
  const Result<Corpus> corpus = Corpus::open(folder);
  if (!corpus) return corpus.issue();
  std::vector<Issue> damaged;
  Baseline known;
  for (const Bucket& bucket : corpus->buckets(damaged))
    if (bucket.state != BucketState::fixed) known.insert(bucket.id);
  if (!damaged.empty()) return damaged.front();
  return known;
}

Result<Baseline> from_list(const std::string& path, const Json& list) {
  Baseline known;
  for (std::size_t i = 0; list.is_array() && i < list.size(); ++i) {
    const Json& entry = list[i];
    if (!entry.is_object() || !entry.contains("id") || !entry["id"].is_string())
      return Issue{"baseline.no_id", "/" + std::to_string(i), path + ": expected an object with an \"id\""};
    if (!entry.contains("state") || entry["state"] != state_name(BucketState::fixed))
      known.insert(entry["id"].get<std::string>());
  }
  if (!list.is_array())
    return Issue{"baseline.no_list", "", path + ": expected a list as `contort corpus list --json` prints it"};
  return known;
}

}  // namespace

Result<Baseline> read_baseline(const std::string& path) {
  if (std::error_code error; std::filesystem::is_directory(path, error)) return from_corpus(path);
  const Result<std::string> text = read_regular_file(path, json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  const Result<Json> list = json_fields::parse_document(*text);
  if (!list) return Issue{list.issue().code, list.issue().pointer, path + ": " + list.issue().text};
  return from_list(path, *list);
}

bool is_gating(const Bucket& bucket, const std::string& today, const Baseline& known) {
  return is_gating(bucket, today) && !known.contains(bucket.id);
}

}  // namespace contort
