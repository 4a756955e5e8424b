// Failing cases of a run, for programs: one JSON object to a line.
#pragma once

#include <functional>
#include <string>

#include "fuzz/run.h"
#include "model/core/output.h"

namespace contort::cli {

class CaseLog {
 public:
  // Opens the log; without a path it writes nothing. A resumed run appends to the file. Code file.unwritable.
  static Result<CaseLog> open(const std::string& path, bool goes_on);

  // The listener that writes cases; empty if nothing is written. The log must stay in place.
  std::function<void(const FailingCase&)> listener();

  // Returns true if every line was written.
  Result<Done> close();

 private:
  bool is_kept() const { return !path_.empty(); }
  void add(const FailingCase& failing);

  std::string path_;
  OutputFile out_;
  bool lost_ = false;  // a line that could not be written
};

}  // namespace contort::cli
