// The data of a failure that the viewer shows: its motions with everything that happened in them, contort.report_case/1
// (docs/report.md).
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

// Margins over time that are kept of a motion: the failure's, and those that came nearest to their limits.
inline constexpr std::size_t kMostCurves = 16;

// JSON in one line, safe inside of a <script>. The first of `shown` is what the failure is told by. `strip`: path of
// its film strip from the page, "" where there is none. Codes of the generator, which may refuse by now what it did
// then.
Result<std::string> case_data(const std::string& key, std::span<const ShownCase> shown, Generator& generator,
                              const CheckSettings& settings, const std::string& strip = "");

// The viewer gets this if the case cannot be shown: a sentence that says why.
std::string case_problem(const std::string& key, const std::string& why);

// The same as the file that a page loads (renders/page_call.h); and back, "" where the text is no such file.
std::string case_script(const std::string& key, const std::string& data, const std::string& stamp = "");
std::string data_of_script(const std::string& key, const std::string& script);

}  // namespace contort
