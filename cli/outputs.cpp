#include "cli/outputs.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "model/core/output.h"
#include "renders/ci_outputs.h"

namespace contort::cli {

void add_baseline_option(CLI::App& command, std::string& baseline) {
  command
      .add_option("--baseline", baseline,
                  "Corpus, or file with the output of `contort corpus list --json`: failures that it has do not gate")
      ->type_name("FILE|CORPUS");
}

void add_output_options(CLI::App& command, OutputRequest& request) {
  command.add_option("--junit", request.junit, "Write JUnit XML: a test case for each bucket")->type_name("FILE");
  command.add_option("--sarif", request.sarif, "Write SARIF 2.1.0 for code scanning")->type_name("FILE");
  command.add_option("--markdown", request.markdown, "Append a summary to this file, such as $GITHUB_STEP_SUMMARY")
      ->type_name("FILE");
  command.add_flag("--github", request.github, "Print annotations for GitHub, at most 10");
  add_baseline_option(command, request.baseline);
}

Result<Baseline> load_baseline(const std::string& path) {
  return path.empty() ? Result<Baseline>(Baseline{}) : read_baseline(path);
}

Result<Done> check_outputs(const OutputRequest& request) {
  for (const std::string& path : {request.junit, request.sarif, request.markdown})
    if (const Result<Done> writable = path.empty() ? Done{} : check_output(path); !writable) return writable;
  return Done{};
}

Result<Done> write_outputs(const OutputRequest& request, const ReportModel& model, std::FILE* annotations) {
  if (!request.junit.empty())
    if (const Result<Done> written = write_output(request.junit, junit_xml(model)); !written) return written;
  if (!request.sarif.empty())
    if (const Result<Done> written = write_output(request.sarif, sarif_json(model)); !written) return written;
  if (!request.markdown.empty())
    if (const Result<Done> written = append_output(request.markdown, markdown_summary(model)); !written) return written;
  if (request.github)
    for (const std::string& line : github_annotations(model)) std::fprintf(annotations, "%s\n", line.c_str());
  return Done{};
}

}  // namespace contort::cli
