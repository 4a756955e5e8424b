// contort merge: merges the corpora of shards, nights and machines.
#include "corpus/merge.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/against.h"
#include "cli/commands.h"
#include "cli/print.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

struct MergeOptions {
  std::vector<std::string> sources;
  std::string output;
  bool require_complete = false;
  bool json = false;
};

void print(const MergeOptions& options, const Merged& merged, std::size_t buckets) {
  if (options.json) {
    const json_fields::Json out = {{"buckets", buckets}, {"incomplete", merged.incomplete}, {"leads", merged.leads}};
    std::printf("%s\n", out.dump(2).c_str());
    return;
  }
  for (const std::string& sentence : merged.incomplete) std::printf("INCOMPLETE %s\n", sentence.c_str());
  std::printf("RESULT buckets=%zu incomplete=%zu leads=%d\n", buckets, merged.incomplete.size(), merged.leads);
}

void run(const MergeOptions& options, Context& context) {
  std::vector<Corpus> sources;
  for (const std::string& folder : options.sources) {
    Result<Corpus> corpus = Corpus::open(folder);
    if (!corpus) return context.fail(corpus.issue());
    sources.push_back(std::move(corpus).value());
  }
  if (const Result<Done> fit = check_same_pair(sources); !fit) return context.fail(fit.issue());
  const Result<Corpus> into = Corpus::create(options.output);
  if (!into) return context.fail(into.issue(), exit_of(into.issue()));
  std::vector<Corpus> all = sources;
  all.push_back(*into);
  if (const Result<Done> fit = check_same_pair(all); !fit) return context.fail(fit.issue());
  const Result<Merged> merged = merge(sources, *into);
  if (!merged) return context.fail(merged.issue(), kInternal);
  std::vector<Issue> damaged = merged->damaged;
  const std::size_t buckets = into->buckets(damaged).size();
  for (const Issue& issue : damaged) context.fail(issue);  // reported; everything else was merged
  if (options.require_complete && !merged->incomplete.empty()) context.exit_code = kInconclusive;
  warn_of_other_rules(*into);
  print(options, *merged, buckets);
}

}  // namespace

void add_merge(CLI::App& app, Context& context) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command = app.add_subcommand("merge", "Merge the corpora of shards, nights or machines");
  command->add_option("CORPUS", options->sources, "Corpus folders")->required();
  command->add_option("-o,--output", options->output, "Corpus to which they are added; created if it does not exist")
      ->required();
  command->add_flag("--require-complete", options->require_complete, "Exit with 4 if shards of a run are missing");
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer("Example: contort merge shard-0 shard-1 shard-2 -o night");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
