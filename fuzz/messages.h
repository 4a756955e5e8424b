// The tasks that a run gives its workers, and their answers: one type for each, as JSON, so that it can be read in a
// debugger and is checked on arrival.
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
  std::vector<std::string> tested;  // labels of what the case was made of
  std::vector<Family> broken;       // by their first frame, then the deepest in its check's scale
  std::vector<NearMiss> near;       // of the subjects of the island's group
  std::vector<WaiverUse> waivers;
  std::optional<Comparison> against{};  // of a run that compares two builds
  bool operator==(const EvaluateReport&) const = default;
};

// The families of `broken` that a run counts: all, or those that broke or got worse against the base.
std::vector<Family> counted_families(const EvaluateReport& report);

// Settle a failure of a case: run it again, keep it as a lead, shrink it.
struct SettleTask {
  Lineage lineage;
  Family family;
  int rank = 0;             // of the family among those of the case, by first frame
  std::string motion_hash;  // of the first time
  bool guarded = false;     // the case, or a candidate of its shrinking, ended a process before
  bool shrinks = true;      // false: there is no time; the lead waits
  std::string base_hash{};  // of the base's motion the first time, in a run that compares
  bool operator==(const SettleTask&) const = default;
};

// Shrink a lead that waits since the time of some run was up.
struct ShrinkTask {
  std::string lead;      // path of its original
  bool guarded = false;  // a candidate ended a process before
  bool operator==(const ShrinkTask&) const = default;
};

// A lead as it is kept in the corpus, and those of other families that its shrinking left there.
struct SettledLead {
  Lead lead;
  bool confirmed = false;  // the second time was bit for bit the first
  std::vector<Lead> incidental;
  std::vector<Lead> incidental_unconfirmed;  // they did not happen again
  std::vector<Family> incidental_of_base{};  // endings that the base shows as well: they do not count
  bool operator==(const SettledLead&) const = default;
};

struct SettleReport {
  SettledLead settled;
  std::string issue;  // it could not be written: code and text
  bool operator==(const SettleReport&) const = default;
};

struct ShrinkReport {
  std::optional<SettledLead> shrunk;  // nothing where another process has taken it
  std::string issue;                  // it could not be written: code and text
  bool operator==(const ShrinkReport&) const = default;
};

using Task = std::variant<EvaluateTask, SettleTask, ShrinkTask>;

// Both ends of a message are this program: what cannot be read is its own fault, and throws std::logic_error.
std::string print_task(const Task& task);
Task parse_task(const std::string& text);

// Prints the report that belongs to the task: EvaluateReport, SettleReport or ShrinkReport.
template <class Report>
std::string print_report(const Report& report);
template <class Report>
Report parse_report(const std::string& text);

}  // namespace contort
