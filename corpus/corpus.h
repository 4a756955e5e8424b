// The corpus: one folder per bucket, so that links stay good while a bucket's state changes.
//
//   DIR/buckets/<check>-<bucket12>/bucket.json       state, family, features, counts
//                                  min-<spec16>.json   smallest failing spec: what people look at
//                                  worst-<spec16>.json deepest violation seen
//                                  orig-<spec16>.json  the spec that min was shrunk from
//   DIR/leads/<bucket12>-<spec16>.json               found, not shrunk yet; survives a kill
//   DIR/runs/<run>.json                              what a run did: cases, frames, what they were made of
//
// Every write is atomic, and every update takes a minimum (by cost) or a maximum (by depth), so the order of adding
// does not matter.
#pragma once

#include <cstdint>
#include <map>
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
  std::map<std::string, std::int64_t> seen;  // cases of this family, by run; a run that is repeated counts once
  std::string min;                           // file names in the bucket's folder
  std::string worst;
  std::string orig;
  bool operator==(const Bucket&) const = default;
};

// A failure on its way into the corpus.
struct Found {
  Case minimal;
  Case original;
  std::string run;        // name of the run for Bucket::seen
  std::int64_t seen = 1;  // cases of this family in that run
};

// What a run did. The same run for longer replaces it; nothing in it depends on time or machine.
struct RunRecord {
  std::string name;  // "seed_7_0123abcd"
  std::string tool;
  std::int64_t cases = 0;
  std::int64_t frames = 0;
  std::int64_t failing = 0;                    // cases with at least one finding
  std::map<std::string, std::int64_t> tested;  // "action pose on arm_left", "part mech_arm_shield": cases or uses
  bool operator==(const RunRecord&) const = default;
};

class Corpus {
 public:
  // Makes the folders where they are missing and tries to write; code file.unwritable.
  static Result<Corpus> create(const std::string& folder);
  // Code corpus.not_found where the folder holds no corpus.
  static Result<Corpus> open(const std::string& folder);

  // Keeps a failure that is not shrunk yet; the path of its file.
  Result<std::string> add_lead(const Case& lead) const;

  // Stores a failure under its bucket. `is_new`: the bucket was not there before.
  struct Added {
    std::string bucket;  // folder of the bucket
    bool is_new = false;
  };
  Result<Added> add(const Found& found) const;

  // Keeps the record unless one of the same name with more cases is there. The texts of `tested` are labels.
  Result<Done> add_run(const RunRecord& run) const;
  std::vector<RunRecord> runs(std::vector<Issue>& damaged) const;  // by name

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
