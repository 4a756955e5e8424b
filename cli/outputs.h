// The files of a corpus that CI reads, and the baseline that decides what gates there. `report` and `fuzz` share it.
#pragma once

#include <cstdio>
#include <string>

#include "cli/commands.h"
#include "corpus/baseline.h"
#include "renders/report.h"

namespace CLI {
class App;
}

namespace contort::cli {

struct OutputRequest {
  std::string junit;  // paths of files, "" for none
  std::string sarif;
  std::string markdown;  // appended to, like $GITHUB_STEP_SUMMARY, so that the summary of a job's earlier steps stays
  bool github = false;   // annotations on standard output
  std::string baseline;  // file or corpus, "" for none
  bool wanted() const { return github || !junit.empty() || !sarif.empty() || !markdown.empty(); }
};

// Declares --junit, --sarif, --markdown, --github and --baseline.
void add_output_options(CLI::App& command, OutputRequest& request);
void add_baseline_option(CLI::App& command, std::string& baseline);

// Without a path, the baseline is empty.
Result<Baseline> load_baseline(const std::string& path);

// Checks, before the work begins, that the requested files can be written; code file.unwritable.
Result<Done> check_outputs(const OutputRequest& request);

// Writes the requested files; code file.unwritable. Annotations are workflow commands, which GitHub reads from both
// streams.
Result<Done> write_outputs(const OutputRequest& request, const ReportModel& model, std::FILE* annotations);

}  // namespace contort::cli
