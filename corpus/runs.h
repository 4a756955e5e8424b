// The record of a run and of the failures that it found: DIR/runs/<run>.json. The counts of the shards of a run are
// added up.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "corpus/refusals.h"

namespace contort {

// The number of cases of one family, and the first of them. The first cases of all families together are the
// discovery curve.
struct FamilyCount {
  std::int64_t cases = 0;
  std::int64_t first_index = 0;  // index of the first of these cases
  // Ascending indices of the first cases in which the family was one of the earliest failures
  // (RunConfig::shrinks_per_case); at most shrinks_per_family of the run.
  std::vector<std::int64_t> first_indices;
  std::string first_arm;  // "guided": how the case of first_index was drawn
  std::int64_t groups = 0;  // groups of cases (RunRecord::groups) with at least one of them
  bool operator==(const FamilyCount&) const = default;
};

// The results of one way of drawing cases.
struct StrategyCount {
  std::int64_t cases = 0;
  std::int64_t failing = 0;
  bool operator==(const StrategyCount&) const = default;
};

// The comparison of a run with another build (docs/reference/against.md). Counts are of cases.
struct AgainstCounts {
  std::string base;          // version and content hash of the other build
  std::string build;         // version and content hash of this build
  std::int64_t same = 0;     // the motions are equal, and no family changed
  std::int64_t moved = 0;    // the motions differ, but no family broke, got worse or was mended
  std::int64_t broke = 0;    // at least one family fails here and passes in the base
  std::int64_t worse = 0;    // at least one family fails in both, and much deeper here
  std::int64_t mended = 0;   // at least one family fails in the base and passes here
  std::int64_t refused = 0;  // the base refused the spec, crashed, hung or used too much memory
  std::int64_t first_moved = -1;    // index of the first case that moved; -1 if no case did
  int first_moved_frame = -1;       // the first frame in which its motions differ
  std::int64_t first_refused = -1;  // index of the first refused case; -1 if none was refused
  std::string first_refusal;        // its reason
  bool operator==(const AgainstCounts&) const = default;
};

// The record of one run, or of shard `shard` of `shards`; a whole run is shard 0 of 1. Nothing in it depends on time
// or machine.
struct RunRecord {
  std::string name;  // "seed_7_0123abcd"
  std::string tool;
  int shard = 0;
  int shards = 1;
  int shrinks_per_family = 2;  // number of first cases of each family that are stored in buckets
  std::int64_t cases = 0;
  std::int64_t frames = 0;
  std::int64_t failing = 0;                     // cases with at least one finding
  std::int64_t groups = 0;                      // groups of cases that share a setting (fuzz/stages.h); 0: not counted
  std::int64_t discarded = 0;                   // drawn specs that were refused; a fault if the generator is built in
  std::map<std::string, std::int64_t> tested;   // "action pose on arm_left", "part mech_arm_shield": cases or uses
  std::map<std::string, std::int64_t> unmet{};       // "reach on arm_left: out_of_reach": cases with such a request
  std::map<std::string, std::int64_t> not_judged{};  // "balance: the motion has no dynamics": cases
  std::map<Family, FamilyCount> families;
  std::map<std::string, StrategyCount> arms;         // "uniform", "guided"
  std::optional<AgainstCounts> against;  // for a run that was compared; only failures that count in the comparison are
                                         // then failures of the run
  RefusalCounts refusals{};              // the reasons of the specs that were refused
  bool operator==(const RunRecord&) const = default;
};

// The name of a record, such as "seed_7_0123abcd", or for a shard "seed_7_0123abcd.shard_3_of_16".
std::string record_name(const RunRecord& run);

// Reads a record. Code json.* if it is not of this version.
Result<RunRecord> read_run(const std::string& path);

// Adds the counts of each label.
void add_counts(const std::map<std::string, std::int64_t>& from, std::map<std::string, std::int64_t>& to);

void drop_run(const Corpus& corpus, const RunRecord& run);

// Stores the record, unless one of the same name with more cases exists.
Result<Done> keep_run(const Corpus& corpus, const RunRecord& run);

// The sum of all shards of one run; there must be at least one.
RunRecord added_up(const std::vector<RunRecord>& shards);

// Returns all records, sorted by file name. Files that cannot be read are reported in `damaged`.
std::vector<RunRecord> runs_of(const Corpus& corpus, std::vector<Issue>& damaged);

}  // namespace contort
