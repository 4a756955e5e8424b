// The case files of a bucket's folder. What is replaced stays until bucket.json names the new ones.
#pragma once

#include <string>
#include <vector>

#include "corpus/bucket.h"

namespace contort {

class BucketFiles {
 public:
  explicit BucketFiles(std::string folder) : folder_(std::move(folder)) {}

  // Keeps a minimal case and the one that it was shrunk from (nullptr: it was pruned) where they are cheaper than what
  // is there. They stay together.
  Result<Done> put_pair(const Case& minimal, const Case* original, Bucket& bucket);
  // Keeps the case where it is deeper than what is there.
  Result<Done> put_worst(const Case& shown, Bucket& bucket);

  // Writes bucket.json, then removes what it names no more.
  Result<Done> commit(const Bucket& bucket) const;

 private:
  Result<Done> put(std::string_view role, const Case& next, std::string& current);

  std::string folder_;
  std::vector<std::string> replaced_;
};

// Adds a bucket from folder `from` to what is in folder `to`, if anything is: the cheapest and the deepest cases, the
// state that was changed more often, all runs.
Result<Done> merge_bucket(const std::string& from, const Bucket& source, const std::string& to);

// The files that min, worst and orig name, as far as they name something.
std::vector<std::string> files_of(const Bucket& bucket);

}  // namespace contort
