// The case files of a bucket's folder. Replaced files stay until bucket.json names the new ones.
#pragma once

#include <string>
#include <vector>

#include "corpus/bucket.h"

namespace contort {

class BucketFiles {
 public:
  explicit BucketFiles(std::string folder) : folder_(std::move(folder)) {}

  // Stores a minimal case and the case that it was shrunk from (nullptr: it was pruned), if they are cheaper than the
  // present pair. The two stay together.
  Result<Done> put_pair(const Case& minimal, const Case* original, Bucket& bucket);
  // Stores the case if it is deeper than the present worst case.
  Result<Done> put_worst(const Case& shown, Bucket& bucket);

  // Writes bucket.json, then removes the files that it no longer names.
  Result<Done> commit(const Bucket& bucket) const;

 private:
  Result<Done> put(std::string_view role, const Case& next, std::string& current);

  std::string folder_;
  std::vector<std::string> replaced_;
};

// Merges a bucket from folder `from` into folder `to`: the cheapest and the deepest cases, the state that was changed
// more often, and all runs.
Result<Done> merge_bucket(const std::string& from, const Bucket& source, const std::string& to);

// The files that min, worst and orig name; empty names are left out.
std::vector<std::string> files_of(const Bucket& bucket);

}  // namespace contort
