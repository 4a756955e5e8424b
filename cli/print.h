// Findings and buckets as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "checks/circumstances.h"
#include "checks/fold.h"
#include "checks/waive.h"
#include "corpus/bucket.h"
#include "corpus/corpus.h"

namespace contort::cli {

// "self_collision  arm_left/forearm ~ torso/trunk  31 mm deep in each other, limit 0 mm  frames 12-40, worst 20 (0.333
// s)  blend: reach (arm_left)". `value` is failed_text() of the finding.
std::string finding_line(const Finding& finding, const std::string& value, double rate_hz,
                         const Circumstances& at_worst);

// A JSON list: check, subject, unit, margin (null for NaN), depth, frames and times, and the circumstances of the worst
// frame. `at_worst` has one entry for each finding.
std::string findings_json(const std::vector<Finding>& findings, double rate_hz,
                          const std::vector<Circumstances>& at_worst);

// The effects of waivers: one line for each waiver that has expired or hides nothing any more, and one for each that
// hid something.
std::vector<std::string> waiver_lines(const CheckSettings& settings, const std::vector<WaiverUse>& uses);
std::string waivers_json(const CheckSettings& settings, const std::vector<WaiverUse>& uses);

// Replaces line ends and control characters by "?", because names from files may contain them.
std::string printable(const std::string& text);

// The notes of people about a bucket, as far as there are any: "ana, ticket 12, until 2027-03-01: soft stop".
std::string known_text(const Bucket& bucket, const std::string& today);

// Warns on standard error if a corpus has buckets that were named by the rules of another version.
void warn_of_other_rules(const Corpus& corpus);

// Prints a number with this many decimals; in short form if it has more than nine digits before the point.
std::string decimal(double value, int digits);

// A finite number in the form of the report (renders/wording.h); "nan" for NaN and infinite values.
std::string short_number(double value);

}  // namespace contort::cli
