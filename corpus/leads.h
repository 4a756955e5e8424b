// A lead is a failure that is not in a bucket yet, as case files that can be replayed:
//
// DIR/leads/<run>/<family12>-<index>.json the drawn case; written as soon as it is to be processed
//                   <family12>-<index>-min.json   the case that it was shrunk to
//                   <family12>-<index>-worst.json the deepest case with the same failure
//                   <family12>-<index>-orig.json  the drawn case, if another of its families names the minimal case
//
// Leads make sure that a kill loses nothing, and that a shard can hand over failures. A failure that was found while
// another one was shrunk is a lead of its own and is treated like that one; the hash in its name is over both families.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corpus/corpus.h"

namespace contort {

struct Lead {
  std::string run;
  Case original;                // provenance.index is the index of its case in the run
  std::optional<Case> minimal;  // set once the lead was shrunk
  std::optional<Case> worst{};
  std::optional<Case>
      shrunk_from{};  // `original` as a case of the family of `minimal`, if that is another family (fuzz/precursor.h)
  bool operator==(const Lead&) const = default;
};

// The reason why a lead of an ended run is not in a bucket (shrink_stopped of its original): its time was up, and the
// next run on the corpus shrinks it; or it did not fail in the same way again.
inline constexpr char kWaits[] = "time", kUnsteady[] = "flaky";
bool waits(const Lead& lead);
bool is_unsteady(const Lead& lead);

// The families that its minimal spec shows. In the same case these need no bucket of their own. Empty before the lead
// was shrunk.
std::set<Family> families_told_by(const Lead& lead);

// Writes the cases of a lead. Returns the path of the original.
Result<std::string> keep_lead(const Corpus& corpus, const Lead& lead);

// Reads a lead. `path` is that of the original.
Result<Lead> read_lead(const std::string& path);

// The path of a lead's original.
std::string lead_path(const Corpus& corpus, const Lead& lead);

// Returns all leads, sorted by run, then by hash of the family, then by index. Files that cannot be read are reported
// in `damaged`.
std::vector<Lead> leads_of(const Corpus& corpus, std::vector<Issue>& damaged);

// Adds a shrunk lead to its bucket and removes the lead.
Result<Corpus::Added> file_lead(const Corpus& corpus, const Lead& lead);

void drop_lead(const Corpus& corpus, const Lead& lead);

// Removes the folder of a finished run that has no leads left.
void tidy_leads(const Corpus& corpus, const std::string& run);

}  // namespace contort
