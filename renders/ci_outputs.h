// Writes the report for build servers and code hosts, from the same rows as the page. Equal models give equal texts.
// Only gating rows are failures or errors.
#pragma once

#include <string>
#include <vector>

#include "renders/report.h"

namespace contort {

// JUnit: a test case for each bucket. Buckets that were fixed once are in a suite "regressions", the others in
// "buckets". Known failures are skipped, with the reason.
std::string junit_xml(const ReportModel& model);

// SARIF 2.1.0: a result for each bucket that is not fixed. Code hosts refuse long logs, so results above 5,000 become
// one note.
inline constexpr std::size_t kMostSarifResults = 5000;
std::string sarif_json(const ReportModel& model);

// GitHub workflow commands, one for each gating failure. GitHub shows only 10, so the last line counts the rest.
inline constexpr std::size_t kMostAnnotations = 10;
std::vector<std::string> github_annotations(const ReportModel& model);

// Markdown: the verdict, a table of gating failures, and the number of known ones.
inline constexpr std::size_t kMostMarkdownRows = 100;
std::string markdown_summary(const ReportModel& model);

// Returns the gating rows, then the others, each in the order of the model.
std::vector<const ReportRow*> gating_first(const ReportModel& model);

}  // namespace contort
