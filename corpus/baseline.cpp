#include "corpus/baseline.h"

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
  std::erase_if(buckets, [](const Bucket& bucket) { return bucket.state == BucketState::fixed; });
  for (const Bucket& bucket : buckets) known.add(bucket.id, bucket.family);
  // A bucket without a readable minimal case is known all the same.
  known.causes = cause_ids(cause_members(*corpus, std::move(buckets), damaged));
  return known;
}

std::string text_in(const Json& entry, const char* name) {
  const auto found = entry.find(name);
  return found != entry.end() && found->is_string() ? found->get<std::string>() : "";
}

// A replay has "joint_range-0123456789ab" and what became of it; a list has the id and the state.
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

bool is_gating(const Bucket& bucket, const std::string& today, const Baseline& known) {
  return is_gating(bucket, today) && !known.contains(bucket);
}

std::set<Family> known_families(const std::vector<Bucket>& buckets, const std::string& today, const Baseline& known) {
  std::set<Family> families = known.families;
  for (const Bucket& bucket : buckets)
    if (bucket.state != BucketState::fixed && !is_gating(bucket, today, known)) families.insert(bucket.family);
  return families;
}

}  // namespace contort
