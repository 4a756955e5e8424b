// The report for machines that build: the same rows as the page's, as they are read by build servers and code hosts.
// Equal models give equal texts. What gates is a failure or an error there, and nothing else is.
#pragma once

#include <string>
#include <vector>

#include "renders/report.h"

namespace contort {

// JUnit: a test case for each bucket; those that were fixed once are in a suite "regressions", the others in "buckets".
// Known failures are skipped, with the reason.
std::string junit_xml(const ReportModel& model);

// SARIF 2.1.0: a result for each bucket that is not fixed. Code hosts refuse long logs, so what comes after 5,000
// results is a note.
inline constexpr std::size_t kMostSarifResults = 5000;
std::string sarif_json(const ReportModel& model);

// GitHub workflow commands, one for each failure that gates. More than 10 would not be shown: the last line counts the
// rest.
inline constexpr std::size_t kMostAnnotations = 10;
std::vector<std::string> github_annotations(const ReportModel& model);

// Markdown: the verdict, a table of what gates, and how many are known.
inline constexpr std::size_t kMostMarkdownRows = 100;
std::string markdown_summary(const ReportModel& model);

// Rows that gate, then the others, each in the order of the model.
std::vector<const ReportRow*> gating_first(const ReportModel& model);

}  // namespace contort
