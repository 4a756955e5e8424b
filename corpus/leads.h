// A failure on its way into a bucket, as case files that can be replayed:
//
//   DIR/leads/<run>/<family12>-<index>.json       as it was drawn; written as soon as it is wanted
//                   <family12>-<index>-min.json   what it was shrunk to
//                   <family12>-<index>-worst.json the deepest that shows the same
//                   <family12>-<index>-orig.json  as it was drawn, if the minimal one is named by another family of it
//
// So a kill loses nothing, and a shard can hand over what it found. A failure that was met while another was shrunk is
// a lead of its own, which goes the way of that other; the hash in its name is over both families.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corpus/corpus.h"

namespace contort {

struct Lead {
  std::string run;
  Case original;                // provenance.index: which case of the run
  std::optional<Case> minimal;  // once it was shrunk
  std::optional<Case> worst{};
  std::optional<Case>
      shrunk_from{};  // original as a case of minimal's family, where that is another (fuzz/precursor.h)
  bool operator==(const Lead&) const = default;
};

// Why a lead of a run that has ended is not in a bucket (shrink_stopped of its original): its time was up, and the next
// run on the corpus shrinks it; or it did not show the same again.
inline constexpr char kWaits[] = "time", kUnsteady[] = "flaky";
bool waits(const Lead& lead);
bool is_unsteady(const Lead& lead);

// Families that its minimal spec shows: of the same case, these need no bucket of their own. None before it was shrunk.
std::set<Family> families_told_by(const Lead& lead);

// Writes what it has; the path of the original.
Result<std::string> keep_lead(const Corpus& corpus, const Lead& lead);

// `path` is the original's.
Result<Lead> read_lead(const std::string& path);

// The path of a lead's original.
std::string lead_path(const Corpus& corpus, const Lead& lead);

// By run, then family's hash, then index. Files that cannot be read are reported in `damaged`.
std::vector<Lead> leads_of(const Corpus& corpus, std::vector<Issue>& damaged);

// Puts a shrunk lead into its bucket and drops it.
Result<Corpus::Added> file_lead(const Corpus& corpus, const Lead& lead);

void drop_lead(const Corpus& corpus, const Lead& lead);

// Removes the folder of a run that has no leads left and writes no more.
void tidy_leads(const Corpus& corpus, const std::string& run);

}  // namespace contort
