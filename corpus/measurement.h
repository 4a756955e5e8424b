// A measurement: the numbers that a build produces for a spec, by which two builds are compared. The lines in which one
// build sends them to another are described in docs/reference/against.md, "Protocol".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/evaluator.h"
#include "model/core/result.h"
#include "model/spec/spec.h"

namespace contort {

inline constexpr char kMeasureFormat[] = "contort.measure/1";

// A request for the margins of one spec.
struct MeasureRequest {
  std::int64_t id = 0;  // the answer repeats it
  Spec spec;
  std::string check;     // only this check is measured; "": all checks
  bool margins = false;  // true: the answer also lists subjects that pass
  bool trace = false;    // true: the answer has the running hash of the motion
  bool operator==(const MeasureRequest&) const = default;
};

// The smallest margin of one subject over a motion, in its check's scale. NaN stands for every margin that is not
// finite.
struct SubjectMargin {
  std::string check;
  std::string subject;
  double margin = 0.0;
  bool waived = false;  // a failure that a waiver of the settings hides
  bool operator==(const SubjectMargin&) const = default;
};

// The answer to a request.
struct Measurement {
  std::int64_t id = 0;
  std::string motion_hash;  // 16 hex digits
  int frames = 0;
  std::string trace;                    // four hex digits a frame, if asked for
  std::vector<SubjectMargin> findings;  // the deepest of each family, sorted by check and subject
  std::vector<SubjectMargin> margins;   // margins of subjects that pass, if requested, sorted in the same way
  std::optional<Issue> refusal;  // set if the spec was refused or the request could not be read; the other fields are
                                 // then unused
};

// The first line of a program that answers requests.
struct MeasureHello {
  std::string version;
  std::vector<std::string> checks;  // names of the checks that it has
};

// Measures the spec, or says why it was refused.
Measurement measure(const MeasureRequest& request, Evaluator& evaluator);

// Makes the measurement from the evaluator's last evaluation, which must be given.
Measurement measurement_of(const MeasureRequest& request, const Evaluation& evaluation, const Evaluator& evaluator);

// Returns the hello of this build; `version` is its version.
MeasureHello own_hello(const std::string& version);

// The functions print and parse one line without its line end. A request may also be a bare spec. Codes measure.* and
// those of parse_spec.
std::string print_line(const MeasureRequest& request);
std::string print_line(const Measurement& measurement);
std::string print_line(const MeasureHello& hello);
Result<MeasureRequest> parse_request(std::string_view line);
Result<Measurement> parse_measurement(std::string_view line);
Result<MeasureHello> parse_hello(std::string_view line);

}  // namespace contort
