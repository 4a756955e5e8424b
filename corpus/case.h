// A case is a spec with its expected failure and its origin. It is one JSON file, contort.case/1.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "checks/family.h"
#include "corpus/cause.h"
#include "corpus/evaluator.h"
#include "model/core/result.h"
#include "model/spec/spec.h"

namespace contort {

// The failure that a run of the spec is expected to show.
struct Expectation {
  std::string check;    // "self_collision"; with the subject and the character's name, the family
  std::string subject;  // "arm_left/forearm ~ torso/trunk"
  std::string unit;     // of worst_margin
  int first_frame = 0;
  int worst_frame = 0;
  int last_frame = 0;
  double worst_margin = 0.0;   // < 0, or NaN
  double depth = 0.0;          // -worst_margin in the check's scale; 0 for NaN
  std::string motion_hash;     // 16 hex digits; "" for a crash, a timeout or memory (isolate.h)
  std::string character_hash;  // the same; another one means that the parts changed since
  std::string trace;           // motion_trace, four hex digits a frame: tells the first frame that differs
  std::string phase{};         // of the worst frame, a name of checks/circumstances.h; "" where no motion was judged
  int limit_s = 0;             // of a timeout: in so many seconds it did not end
  int limit_MB = 0;            // of memory: it took more than this
  std::string printed{};       // the last words of a generator that is a program of its own, before it ended
  bool operator==(const Expectation&) const = default;
};

// The origin of the case. Not part of its identity.
struct Provenance {
  std::string tool;         // version that found it
  std::int64_t seed = -1;   // of the run; -1: written by a person
  std::int64_t index = -1;  // of the case in the run
  std::string shrunk_from;  // spec_id of the spec before shrinking; "" where it was not
  int shrink_evaluations = 0;
  std::string shrink_stopped;   // "fixpoint", "evaluations", "time", "flaky" or "gone"
  double original_depth = 0.0;  // before any shrinking; the depth that must be kept is a share of it
  int rank = 0;                 // among the failures of its case by first frame; 0: the earliest
  std::string profile;          // of the run, by name; shrinking stays within it. "": it draws everything
  Family met_shrinking;       // of the failure whose shrinking met this one; empty where the case itself showed it
  std::string base{};         // the other build of a comparison, "0.1.0 1a2b…"; "": none (docs/reference/against.md)
  std::string base_shows{};   // by that build for this spec: "passes_check", "passes" or "milder"
  double base_margin = 0.0;   // the base's margin for the family, in the check's scale; 0 if it judged none
  std::string generator{};        // name of the program under test; "": the built-in generator
  std::string generator_build{};  // its build and the hash of its manifest
  bool operator==(const Provenance&) const = default;
};

struct Case {
  Spec spec;
  Expectation expect;
  Provenance provenance;
  std::vector<std::string> free_fields{};  // JSON pointers into the spec: fields that could as well have other values
  std::vector<Family> co_failures{};              // came with it before it was shrunk, and still do
  Cause cause{};                                  // of a minimal case
  bool operator==(const Case&) const = default;
};

Family family_of(const Case& stored);

// The stored cause, or the one that the spec alone tells if none is stored.
Cause cause_of(const Case& minimal);
std::string cause_id_of(const Case& minimal);

// The depth of the failure in its check's scale. NaN is deeper than any finite depth.
double depth_of(const Expectation& expect);

// Returns true for the checks "crash", "timeout" and "memory". They have no row in the manifest, because there is no
// motion to measure.
bool is_abnormal_exit(const Expectation& expect);

// Parses a case file. Codes case.* and json.*.
Result<Case> parse_case(std::string_view json);
std::string print_case(const Case& stored);  // indented, sorted keys
std::string case_schema();

// Makes an expectation from a finding of an evaluation of this execution. It has no phase if the generator gives no
// intent.
Expectation expectation_of(const Execution& execution, const Evaluation& evaluation, const Finding& finding);

}  // namespace contort
