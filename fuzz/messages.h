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

// Task: run a case.
struct EvaluateTask {
  Lineage lineage;
  Family ends{};  // set if the case ends this build (crash, timeout, memory), so that only the base runs it
  bool operator==(const EvaluateTask&) const = default;
};

struct EvaluateReport {
  bool built = false;
  int frames = 0;
  std::string motion_hash;
  std::vector<std::string> tested;  // labels of the actions, parts and so on that the case uses
  std::vector<std::string> unmet;       // requests that the generator could not meet (unmet_labels)
  std::vector<std::string> not_judged;  // checks that could not judge the motion (not_judged_labels)
  std::vector<Family> broken;       // sorted by first frame, then by depth in the check's scale, the deepest first
  std::vector<NearMiss> near;       // near misses of the subjects of the island's group
  std::vector<WaiverUse> waivers;
  std::optional<Comparison> against{};  // only in a run that compares two builds
  std::string refusal{};                // the reason why the spec did not build
  bool operator==(const EvaluateReport&) const = default;
};

// Returns the families of `broken` that a run counts: all, or, with a base, those that broke or got worse.
std::vector<Family> counted_families(const EvaluateReport& report);

// Task: process a failure of a case. Run it again, store it as a lead, shrink it.
struct SettleTask {
  Lineage lineage;
  Family family;
  int rank = 0;             // position of the family among those of the case, by first frame
  std::string motion_hash;  // hash of the motion in the first run
  bool guarded = false;     // the case, or a candidate of its shrinking, has ended a process before
  bool shrinks = true;      // false: there is no time to shrink, and the lead waits
  std::string base_hash{};  // hash of the base's first motion, in a run that compares
  bool operator==(const SettleTask&) const = default;
};

// Task: shrink a lead that waits because the time of a run was up.
struct ShrinkTask {
  std::string lead;      // path of the lead's original
  bool guarded = false;  // a candidate ended a process before
  bool operator==(const ShrinkTask&) const = default;
};

// A lead as it is stored in the corpus, and the leads of other families that its shrinking stored there.
struct SettledLead {
  Lead lead;
  bool confirmed = false;  // the second run was equal to the first in every bit
  std::vector<Lead> incidental;
  std::vector<Lead> incidental_unconfirmed;  // failures that did not happen again
  std::vector<Family> incidental_of_base{};  // crashes, timeouts and memory failures that the base shows as well: they
                                             // do not count
  bool operator==(const SettledLead&) const = default;
};

struct SettleReport {
  SettledLead settled;
  std::string issue;  // code and text if the lead could not be written; else ""
  bool operator==(const SettleReport&) const = default;
};

struct ShrinkReport {
  std::optional<SettledLead> shrunk;  // empty if another process has taken the lead
  std::string issue;                  // code and text if the lead could not be written; else ""
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
