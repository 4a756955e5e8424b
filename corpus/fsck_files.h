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

  // Notes a fault. With repair `mend` is called and says what it did; the first failure of one ends the repairs.
  using Mend = std::function<Result<std::string>()>;
  void add(const std::string& path, const std::string& code, const std::string& text, const Mend& mend);

  // The same for what has to be done once for several faults.
  void mend(const Mend& mend);

  // A fault of what could not be read: "outside" where a link was not followed, and "unreadable" else.
  void add_unread(const std::string& path, const Issue& why, const Mend& mend);

  // A mend: moves a file or folder below invalid/, to the path that it has below the corpus. A link moves as it is.
  Result<std::string> move_aside(const std::string& path) const;

  bool ok() const { return issue_.code.empty(); }
  Result<std::vector<CorpusFault>> take();

 private:
  std::string root_;
  bool repair_;
  std::vector<CorpusFault> faults_;
  Issue issue_;
};

// One folder of buckets/.
void check_bucket_folder(const Corpus& corpus, const std::string& name, FaultList& faults);

bool is_link(const std::string& path);

// The entries of a folder, by name; none where there is no folder.
std::vector<std::string> names_in(const std::string& folder);

}  // namespace contort
