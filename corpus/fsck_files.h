// Shared by the parts of fsck: the list of faults, and moving things aside.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/fsck.h"

namespace contort {

class FaultList {
 public:
  FaultList(std::string root, bool repair) : root_(std::move(root)), repair_(repair) {}

  // Adds a fault. When repairing, it calls `mend`, which returns a description of the repair; the first failure ends
  // the repairs.
  using Mend = std::function<Result<std::string>()>;
  void add(const std::string& path, const std::string& code, const std::string& text, const Mend& mend);

  // Runs a repair that serves several faults.
  void mend(const Mend& mend);

  // Adds a fault of an unreadable file: "outside" if a link was not followed, else "unreadable".
  void add_unread(const std::string& path, const Issue& why, const Mend& mend);

  // A repair: moves a file or folder to invalid/, under the path that it has in the corpus. A link is moved as it is.
  Result<std::string> move_aside(const std::string& path) const;

  bool ok() const { return issue_.code.empty(); }
  Result<std::vector<CorpusFault>> take();

 private:
  std::string root_;
  bool repair_;
  std::vector<CorpusFault> faults_;
  Issue issue_;
};

// Checks one folder of buckets/.
void check_bucket_folder(const Corpus& corpus, const std::string& name, FaultList& faults);

bool is_link(const std::string& path);

// The entries of a folder, sorted by name; none if there is no folder.
std::vector<std::string> names_in(const std::string& folder);

}  // namespace contort
