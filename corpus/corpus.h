// The corpus: one folder per bucket, so that links stay good while a bucket's state changes.
//
//   DIR/buckets/<check>-<bucket12>/bucket.json       state, family, features (bucket.h)
//                                  min-<spec16>.json   smallest failing spec: what people look at
//                                  worst-<spec16>.json deepest violation seen
//                                  orig-<spec16>.json  the spec that min was shrunk from
// DIR/rules.json when its causes show (condition.h)
//   DIR/leads/   found, not in a bucket yet (leads.h)
//   DIR/runs/    what each run did (runs.h)
//   DIR/invalid/ what `contort corpus fsck --repair` put aside (fsck.h)
//   DIR/.lock    held while something is written (lock.h)
//
// Every write is atomic, and every update takes a minimum (by cost) or a maximum (by depth), so the order of adding
// does not matter.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/bucket.h"
#include "corpus/case.h"
#include "model/core/result.h"

namespace contort {

// A failure on its way into the corpus.
struct Found {
  Case minimal;
  Case original;
  std::string run;              // name of the run for Bucket::runs
  std::optional<Case> worst{};  // a third case, if it may be deeper than both
};

class Corpus {
 public:
  // Creates missing folders and tests writing. Code file.unwritable; code folder.other_files if the folder has files
  // but is not a corpus.
  static Result<Corpus> create(const std::string& folder);
  // Opens an existing corpus. Code corpus.not_found if the folder is not a corpus. Both functions: code file.outside
  // if one of the corpus' own folders is a link that leads out of it.
  static Result<Corpus> open(const std::string& folder);

  // Stores a failure in its bucket. `is_new`: the bucket did not exist before. A fixed bucket regresses.
  struct Added {
    std::string bucket;  // name of the bucket's folder
    bool is_new = false;
  };
  Result<Added> add(const Found& found) const;

  // Adds a bucket of another corpus, with its state and cases. Nothing changes if one of its cases cannot be read.
  Result<Done> take(const Corpus& from, const Bucket& bucket) const;

  // Reads a bucket again, applies the change and writes it while no other process writes. Returns the bucket that is
  // now stored.
  using Change = std::function<Result<Bucket>(const Bucket&)>;
  Result<Bucket> change(const Bucket& bucket, const Change& change) const;

  // Removes the bucket and its cases.
  Result<Done> remove(const Bucket& bucket) const;

  // Returns all buckets, sorted by folder name. Folders that cannot be read while nobody writes, and buckets whose
  // names or links lead elsewhere (is_untrusted), are reported in `damaged`, never skipped silently. A caller that
  // holds the corpus' lock must use buckets_under_lock().
  std::vector<Bucket> buckets(std::vector<Issue>& damaged) const;
  std::vector<Bucket> buckets_under_lock(std::vector<Issue>& damaged) const;

  // A stored case of a bucket. If another process has replaced a case since the bucket was read, the bucket is read
  // again, into `bucket`.
  struct Stored {
    std::string path;
    Result<Case> stored;
  };
  std::vector<Stored> cases_of(Bucket& bucket) const;  // min, worst, orig
  Result<Case> minimal_of(Bucket& bucket) const;

  std::string folder_of(const Bucket& bucket) const;
  const std::string& folder() const { return folder_; }

 private:
  explicit Corpus(std::string folder) : folder_(std::move(folder)) {}
  // Returns folder_of() after checking that writing there stays in the corpus.
  Result<std::string> place_of(const Bucket& bucket) const;
  std::string folder_;
};

Result<Case> read_case(const std::string& path);

// Reads FOLDER/FILE of a folder with untrusted contents, but never a file outside of it. Code file.outside.
Result<Case> read_case_of(const std::string& folder, const std::string& file);

}  // namespace contort
