#include "corpus/upkeep.h"

#include <algorithm>
#include <filesystem>

#include "corpus/bucket_files.h"
#include "corpus/lock.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

// Calls `each` for every bucket, with the lock held. Stops before any change if a bucket is unreadable. Buckets whose
// names or links lead elsewhere are skipped.
template <class Each>
Result<Changes> each_bucket(const Corpus& corpus, const Each& each) {
  const Result<CorpusLock> lock = CorpusLock::take(corpus.folder());
  if (!lock) return lock.issue();
  std::vector<Issue> damaged;
  const std::vector<Bucket> buckets = corpus.buckets_under_lock(damaged);
  if (const auto stop = std::ranges::find_if_not(damaged, is_untrusted); stop != damaged.end()) return *stop;
  Changes changes;
  for (const Bucket& bucket : buckets)
    if (const Result<Done> done = each(bucket, changes); !done) return done.issue();
  return changes;
}

Result<Done> move_bucket(const std::string& from, const Bucket& named, const std::string& to) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(to + "/bucket.json", error))) {
    fs::rename(from, to, error);
    if (error) return Issue{"file.unwritable", "", "cannot rename " + from + ": " + error.message()};
    return write_bucket(to, named);
  }
  if (const Result<Done> merged = merge_bucket(from, named, to); !merged) return merged;
  fs::remove_all(from, error);
  if (error) return Issue{"file.unwritable", "", "cannot remove " + from + ": " + error.message()};
  return Done{};
}

Result<Done> rekey_one(const Corpus& corpus, const Bucket& bucket, Changes& changes) {
  const Result<Case> minimal = read_case_of(corpus.folder_of(bucket), bucket.min);
  if (!minimal) return minimal.issue();
  const Bucket right = bucket_of(*minimal);
  Bucket named = bucket;
  named.id = right.id, named.check = right.check, named.family = right.family, named.features = right.features;
  named.signature = right.signature;
  if (named == bucket) return Done{};
  changes.push_back(folder_name(bucket) + " is now " + folder_name(named));
  if (folder_name(named) == folder_name(bucket)) return write_bucket(corpus.folder_of(bucket), named);
  const Result<Done> inside = check_inside(corpus.folder(), corpus.folder_of(named));
  return inside ? move_bucket(corpus.folder_of(bucket), named, corpus.folder_of(named)) : inside;
}

Result<Done> prune_one(const Corpus& corpus, const Bucket& bucket, Changes& changes) {
  if (bucket.state != BucketState::fixed || bucket.orig.empty()) return Done{};
  const Result<std::string> original = place_inside(corpus.folder_of(bucket), bucket.orig);
  if (!original) return original.issue();
  Bucket pruned = bucket;
  pruned.orig.clear();
  if (const Result<Done> written = write_bucket(corpus.folder_of(bucket), pruned); !written) return written;
  changes.push_back(folder_name(bucket) + "/" + bucket.orig + " dropped");
  std::error_code ignored;  // fsck finds files that stay
  fs::remove(*original, ignored);
  return Done{};
}

Result<Done> rewrite(const std::string& folder, const std::string& file, const std::string& text, Changes& changes) {
  const Result<std::string> present = read_inside(folder, file, json_fields::kMaxDocumentBytes);
  if (!present) return present.issue();
  if (*present == text) return Done{};
  changes.push_back(fs::path(folder).filename().string() + "/" + file + " rewritten");
  return write_inside(folder, file, text);
}

Result<Done> migrate_one(const Corpus& corpus, const Bucket& bucket, Changes& changes) {
  const std::string folder = corpus.folder_of(bucket);
  for (const std::string& file : files_of(bucket)) {
    const Result<Case> stored = read_case_of(folder, file);
    if (!stored) return stored.issue();
    if (const auto done = rewrite(folder, file, print_case(*stored), changes); !done) return done;
  }
  return rewrite(folder, "bucket.json", print_bucket(bucket), changes);
}

}  // namespace

std::vector<Issue> left_alone(const Corpus& corpus) {
  std::vector<Issue> damaged;
  corpus.buckets(damaged);
  std::erase_if(damaged, [](const Issue& issue) { return !is_untrusted(issue); });
  return damaged;
}

Result<Changes> rekey(const Corpus& corpus) {
  return each_bucket(corpus, [&](const Bucket& b, Changes& changes) { return rekey_one(corpus, b, changes); });
}

int named_by_other_rules(const Corpus& corpus) {
  std::vector<Issue> ignored;
  const auto by_others = [](const Bucket& bucket) { return bucket.signature != kSignatureVersion; };
  return static_cast<int>(std::ranges::count_if(corpus.buckets(ignored), by_others));
}

Result<Changes> prune(const Corpus& corpus) {
  return each_bucket(corpus, [&](const Bucket& b, Changes& changes) { return prune_one(corpus, b, changes); });
}

Result<Changes> migrate(const Corpus& corpus) {
  return each_bucket(corpus, [&](const Bucket& b, Changes& changes) { return migrate_one(corpus, b, changes); });
}

}  // namespace contort
