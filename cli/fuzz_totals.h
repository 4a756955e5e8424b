// The result of a run, as contort fuzz prints it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corpus/baseline.h"
#include "corpus/causes.h"
#include "cli/sources.h"
#include "fuzz/run.h"

namespace contort::cli {

// The causes of the failures of a run: first those that neither the baseline nor the corpus had before, then the most
// severe.
std::vector<CauseRow> causes_found(const RunResult& result, const Corpus& corpus, const Baseline& baseline);

struct TotalsRequest {
  bool json = false;
  std::string corpus;
  std::string report;  // folder of the report; empty if no report was asked for
  int shrinks_per_case = 4;
  const CheckSettings& settings;
  const Sources& sources;
  const std::optional<AgainstConfig>& against;
  const Baseline& baseline;
};

// Prints everything except the last line: failures with their commands, waivers, counts, and the work that is left.
void print_totals(const RunResult& result, const TotalsRequest& request);

// Prints the last line, which has a fixed form.
void print_result(const RunResult& result);

}  // namespace contort::cli
