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
  std::string unit;     // unit of worst_margin
  int first_frame = 0;
  int worst_frame = 0;
  int last_frame = 0;
  double worst_margin = 0.0;   // < 0, or NaN
  double depth = 0.0;          // -worst_margin in the check's scale; 0 for NaN
  std::string motion_hash;     // 16 hex digits; "" for a crash, a timeout or memory (isolate.h)
  std::string character_hash;  // 16 hex digits; differs if the parts have changed since
  std::string trace;           // motion_trace, four hex digits per frame, to find the first frame that differs
  std::string phase{};         // phase of the worst frame, by its name in checks/circumstances.h; "" if no motion was
                               // judged
  int limit_s = 0;             // for a timeout: the time limit that was exceeded, s
  int limit_MB = 0;            // for a memory failure: the limit that was exceeded, MB
  std::string printed{};       // the last output of a generator that is a program of its own, before it ended
  bool operator==(const Expectation&) const = default;
};

// The origin of the case. Not part of its identity.
struct Provenance {
  std::string tool;         // version of Contort that found the failure
  std::int64_t seed = -1;   // seed of the run; -1: written by a person
  std::int64_t index = -1;  // index of the case in the run
  std::string shrunk_from;  // spec_id of the spec before shrinking; "" if it was not shrunk
  int shrink_evaluations = 0;
  std::string shrink_stopped;   // "fixpoint", "evaluations", "time", "flaky" or "gone"
  double original_depth = 0.0;  // depth before any shrinking; the depth that shrinking must keep is a fraction of it
  int rank = 0;                 // position among the failures of its case, by first frame; 0: the earliest
  std::string profile;          // name of the run's profile; shrinking stays within it. "": the default profile, which
                                // draws everything
  Family met_shrinking;       // family of the failure during whose shrinking this one was found; empty if a drawn case
                              // showed it
  std::string base{};         // the other build of a comparison, "0.1.0 1a2b…"; "": none (docs/reference/against.md)
  std::string base_shows{};   // the result of that build for this spec: "passes_check", "passes" or "milder"
  double base_margin = 0.0;   // the base's margin for the family, in the check's scale; 0 if it judged none
  std::string generator{};        // name of the program under test; "": the built-in generator
  std::string generator_build{};  // its build and the hash of its manifest
  bool operator==(const Provenance&) const = default;
};

struct Case {
  Spec spec;
  Expectation expect;
  Provenance provenance;
  std::vector<std::string> free_fields{};  // JSON pointers into the spec: fields whose values do not matter for the
                                           // failure
  std::vector<Family> co_failures{};              // other families that the case showed before it was shrunk, and still
                                                  // shows
  Cause cause{};                                  // only for a minimal case
  bool operator==(const Case&) const = default;
};

Family family_of(const Case& stored);

// Returns the stored cause, or, if none is stored, the cause that follows from the spec alone.
Cause cause_of(const Case& minimal);

// "Left hand goes through right thigh during aim": what fails, and its cause.
std::string cause_headline(const Case& minimal);
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
