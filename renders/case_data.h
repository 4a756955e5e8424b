// Makes the data of a failure for the viewer, contort.report_case/1: its motions with all their events
// (docs/reference/report.md).
#pragma once

#include <span>
#include <string>

#include "checks/settings.h"
#include "corpus/case.h"
#include "model/generator.h"
#include "model/core/result.h"

namespace contort {

// One of the motions that show the failure.
struct ShownCase {
  std::string role;  // "minimal", "original", "worst"
  const Case& stored;
};

// The number of margin curves of a motion: the curve of the failure, and those nearest to their limits.
inline constexpr std::size_t kMostCurves = 16;

// Returns JSON in one line, safe inside of a <script>. The first of `shown` describes the failure. `strip` is the
// path of its film strip relative to the page, "" if there is none. Codes of the generator, which may now refuse a
// spec that it once accepted.
Result<std::string> case_data(const std::string& key, std::span<const ShownCase> shown, Generator& generator,
                              const CheckSettings& settings, const std::string& strip = "");

// Returns the data of a case that cannot be shown, with a sentence about the reason.
std::string case_problem(const std::string& key, const std::string& why);

// Converts the data to the file that a page loads (renders/page_call.h), and back; "" if the text is no such file.
std::string case_script(const std::string& key, const std::string& data, const std::string& stamp = "");
std::string data_of_script(const std::string& key, const std::string& script);

}  // namespace contort
