// The corpus: one folder per bucket, so that links stay good while a bucket's state changes.
//
//   DIR/buckets/<check>-<bucket12>/bucket.json       state, family, features, counts
//                                  min-<spec16>.json   smallest failing spec: what people look at
//                                  worst-<spec16>.json deepest violation seen
//                                  orig-<spec16>.json  the spec that min was shrunk from
//   DIR/leads/   found, not in a bucket yet (leads.h)
//   DIR/runs/    what each run did (runs.h)
//
// Every write is atomic, and every update takes a minimum (by cost) or a maximum (by depth), so the order of adding
// does not matter.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "corpus/case.h"
#include "generator/core/result.h"

namespace contort {

// Coarse features of a minimal spec: what it needed in order to fail. "actions=pose,reach clips=1 sequences=1 swap".
std::string features_of(const Spec& spec);

// 12 hex digits over the family and the features.
std::string bucket_id(const std::string& family, const std::string& features);

// Order of cost between specs that show the same: fewer actions, then shorter text, then the text.
bool cheaper(const Spec& a, const Spec& b);

struct Bucket {
  std::string id;
  std::string check;
  std::string family;
  std::string features;
  std::string state = "new";
  std::vector<std::string> runs;  // that put a case here, by name; how often each saw the family is in runs.h
  std::string min;                           // file names in the bucket's folder
  std::string worst;
  std::string orig;
  bool operator==(const Bucket&) const = default;
};

// A failure on its way into the corpus.
struct Found {
  Case minimal;
  Case original;
  std::string run;  // name of the run for Bucket::runs
  std::optional<Case> worst{};  // another one that may be deeper than both
};

class Corpus {
 public:
  // Makes the folders where they are missing and tries to write; code file.unwritable.
  static Result<Corpus> create(const std::string& folder);
  // Code corpus.not_found where the folder holds no corpus.
  static Result<Corpus> open(const std::string& folder);

  // Stores a failure under its bucket. `is_new`: the bucket was not there before.
  struct Added {
    std::string bucket;  // folder of the bucket
    bool is_new = false;
  };
  Result<Added> add(const Found& found) const;

  // All buckets, by folder name. Folders that cannot be read are reported in `damaged`, never skipped silently.
  std::vector<Bucket> buckets(std::vector<Issue>& damaged) const;

  std::string folder_of(const Bucket& bucket) const;
  const std::string& folder() const { return folder_; }

 private:
  explicit Corpus(std::string folder) : folder_(std::move(folder)) {}
  std::string folder_;
};

Result<Case> read_case(const std::string& path);

}  // namespace contort
