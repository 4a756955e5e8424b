// The tasks that a run gives its workers, and their answers. Each has a type, and is sent as JSON, so that it can be
// read in a debugger and is checked on arrival.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "checks/waive.h"
#include "corpus/leads.h"
#include "fuzz/comparison.h"
#include "fuzz/islands.h"
#include "fuzz/lineage.h"

namespace contort {

// Run a case.
struct EvaluateTask {
  Lineage lineage;
  Family ends{};  // the crash, timeout or memory by which the case ends this build: only the base runs it; else empty
  bool operator==(const EvaluateTask&) const = default;
};

struct EvaluateReport {
  bool built = false;
  bool unmet = false;  // the generator could not meet a request
  int frames = 0;
  std::string motion_hash;
  std::vector<std::string> tested;  // labels of the actions, parts and so on that the case uses
  std::vector<Family> broken;       // by their first frame, then the deepest in its check's scale
  std::vector<NearMiss> near;       // of the subjects of the island's group
  std::vector<WaiverUse> waivers;
  std::optional<Comparison> against{};  // only in a run that compares two builds
  bool operator==(const EvaluateReport&) const = default;
};

// The families of `broken` that a run counts: all, or those that broke or got worse against the base.
std::vector<Family> counted_families(const EvaluateReport& report);

// Process a failure of a case: run it again, store it as a lead, shrink it.
struct SettleTask {
  Lineage lineage;
  Family family;
  int rank = 0;             // of the family among those of the case, by first frame
  std::string motion_hash;  // of the first run
  bool guarded = false;     // the case, or a candidate of its shrinking, has ended a process before
  bool shrinks = true;      // false: there is no time; the lead waits
  std::string base_hash{};  // of the base's first motion, in a run that compares
  bool operator==(const SettleTask&) const = default;
};

// Shrink a lead that waits because the time of a run was up.
struct ShrinkTask {
  std::string lead;      // path of its original
  bool guarded = false;  // a candidate ended a process before
  bool operator==(const ShrinkTask&) const = default;
};

// A lead as it is stored in the corpus, and the leads of other families that its shrinking stored there.
struct SettledLead {
  Lead lead;
  bool confirmed = false;  // the second run was equal to the first in every bit
  std::vector<Lead> incidental;
  std::vector<Lead> incidental_unconfirmed;  // failures that did not happen again
  std::vector<Family> incidental_of_base{};  // endings that the base shows as well: they do not count
  bool operator==(const SettledLead&) const = default;
};

struct SettleReport {
  SettledLead settled;
  std::string issue;  // it could not be written: code and text
  bool operator==(const SettleReport&) const = default;
};

struct ShrinkReport {
  std::optional<SettledLead> shrunk;  // empty if another process has taken the lead
  std::string issue;                  // it could not be written: code and text
  bool operator==(const ShrinkReport&) const = default;
};

using Task = std::variant<EvaluateTask, SettleTask, ShrinkTask>;

// Both ends of a message are this program, so a message that cannot be read is our own error, and throws
// std::logic_error.
std::string print_task(const Task& task);
Task parse_task(const std::string& text);

// Prints the report that belongs to the task: EvaluateReport, SettleReport or ShrinkReport.
template <class Report>
std::string print_report(const Report& report);
template <class Report>
Report parse_report(const std::string& text);

}  // namespace contort
