// The result of a run, as contort fuzz prints it.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corpus/causes.h"
#include "cli/sources.h"
#include "fuzz/run.h"

namespace contort::cli {

// The causes of the failures of a run, the most severe first, and the ids of those that the corpus had before.
struct FoundCauses {
  std::vector<CauseRow> rows;
  std::set<std::string> known;
};
FoundCauses causes_found(const RunResult& result, const Corpus& corpus);

struct TotalsRequest {
  bool json = false;
  std::string corpus;
  std::string report;  // folder of the report; empty if no report was asked for
  int shrinks_per_case = 4;
  const CheckSettings& settings;
  const Sources& sources;
  const std::optional<AgainstConfig>& against;
  const std::set<std::string>& known_causes;  // of the baseline: they are not new
};

// All but the last line: failures with their commands, waivers, counts, and what is left to do.
void print_totals(const RunResult& result, const TotalsRequest& request);

// The last line, whatever else was printed.
void print_result(const RunResult& result);

}  // namespace contort::cli
