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
  std::string check;     // this check alone; "": all
  bool margins = false;  // subjects that pass are listed, too
  bool trace = false;    // the running hash of the motion is wanted
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
  std::vector<SubjectMargin> margins;   // of subjects that pass, if asked for, sorted in the same way
  std::optional<Issue> refusal;  // the spec was refused, or the request could not be read; then nothing else counts
};

// The first line of a program that answers requests.
struct MeasureHello {
  std::string version;
  std::vector<std::string> checks;  // that it can judge by
};

// Measures the spec, or says why it was refused.
Measurement measure(const MeasureRequest& request, Evaluator& evaluator);

// The same from an evaluation of the evaluator's that has just been made.
Measurement measurement_of(const MeasureRequest& request, const Evaluation& evaluation, const Evaluator& evaluator);

// The hello of this build, which calls itself `version`.
MeasureHello own_hello(const std::string& version);

// Lines without their line end. A request may also be a bare spec. Codes measure.* and those of parse_spec.
std::string print_line(const MeasureRequest& request);
std::string print_line(const Measurement& measurement);
std::string print_line(const MeasureHello& hello);
Result<MeasureRequest> parse_request(std::string_view line);
Result<Measurement> parse_measurement(std::string_view line);
Result<MeasureHello> parse_hello(std::string_view line);

}  // namespace contort
