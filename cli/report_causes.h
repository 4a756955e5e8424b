// The causes of a report and the conditions under which they show.
#pragma once

#include <vector>

#include "corpus/baseline.h"
#include "corpus/causes.h"
#include "renders/report.h"

namespace contort::cli {

// Adds the causes of failures that are not fixed, and the headline of its cause to each row.
void add_cause_rows(std::vector<CauseMember> members, const std::vector<RunRecord>& runs, const Baseline& known,
                    const GroupCounts& now, ReportModel& model);

// Adds the sentences of rules that were learned from cases that are still minimal cases of their cause.
Result<Done> add_conditions(const Corpus& corpus, const std::vector<CauseMember>& members, ReportModel& model);

}  // namespace contort::cli
