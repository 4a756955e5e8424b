// A round: the cases between two updates of the search. It chooses the next case for a worker and collects the results,
// which arrive in any order and are processed in the order of the cases.
#pragma once

#include <optional>
#include <vector>

#include "corpus/case.h"
#include "fuzz/messages.h"

namespace contort {

struct RoundCase {
  Lineage lineage;
  std::optional<EvaluateReport> report{};
  std::optional<Case> ended_once{};  // the failure of the first run if it ended its process, but the second run did not
  bool ends_process = false;         // both runs ended their process
  Family ends{};                     // the way in which it ended its process, if the base must run it too
};

class Round {
 public:
  // `asks_base`: a case that ends this build is given out once more, for the base alone.
  explicit Round(bool asks_base = false) : asks_base_(asks_base) {}
  void add(const Lineage& lineage);

  // Returns the place of the next case for a worker; cases that are to be tried again go first.
  std::optional<int> next();
  EvaluateTask task(int place) const;

  void take_report(int place, EvaluateReport report);

  // A task that ended its process is tried again, because the process may have been ended from outside: by a person, or
  // for lack of memory. `is_known`: this failure occurred before, and needs no second run.
  void take_ending(int place, const Case& ended, bool is_known);

  int size() const { return static_cast<int>(cases_.size()); }
  int done_count() const { return size() - open_; }
  bool is_whole() const { return open_ == 0; }
  bool has_failure() const;
  const std::vector<RoundCase>& cases() const { return cases_; }

 private:
  void close(int place, EvaluateReport report);

  bool asks_base_;
  std::vector<RoundCase> cases_;
  int open_ = 0;            // cases without a report
  int given_ = 0;           // cases that were handed out
  std::vector<int> again_;  // places whose process ended, to be tried once more
};

}  // namespace contort
