#include "cli/corpus_upkeep.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/print.h"
#include "corpus/fsck.h"
#include "corpus/upkeep.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

using json_fields::Json;

struct FsckOptions {
  std::string corpus;
  bool repair = false;
  bool json = false;
};

void print_fault(const CorpusFault& fault) {
  std::printf("%-12s  %s  %s%s\n", fault.code.c_str(), printable(fault.path).c_str(), printable(fault.text).c_str(),
              fault.mended.empty() ? "" : ("  -> " + printable(fault.mended)).c_str());
}

void run_fsck(const FsckOptions& options, Context& context) {
  const Result<Corpus> corpus = Corpus::open(options.corpus);
  if (!corpus) return context.fail(corpus.issue());
  const Result<std::vector<CorpusFault>> faults = check_files(*corpus, options.repair);
  if (!faults) return context.fail(faults.issue(), exit_of(faults.issue()));
  Json list = Json::array();
  for (const CorpusFault& fault : *faults) {
    list.push_back({{"path", fault.path}, {"code", fault.code}, {"text", fault.text}, {"mended", fault.mended}});
    if (!options.json) print_fault(fault);
  }
  if (!options.repair && !faults->empty()) context.exit_code = kFindings;
  if (options.json)
    std::printf("%s\n", list.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  else
    std::printf("%zu faults%s\n", faults->size(), options.repair || faults->empty() ? "" : "; --repair mends them");
}

void add_fsck(CLI::App& corpus, Context& context) {
  auto options = std::make_shared<FsckOptions>();
  CLI::App* command = corpus.add_subcommand("fsck", "Check the files of a corpus, and repair them");
  command->add_option("CORPUS", options->corpus, "Corpus folder")->required();
  command->add_flag("--repair", options->repair, "Repair; files that are not understood move to CORPUS/invalid");
  command->add_flag("--json", options->json, "Print as JSON");
  command->footer(
      "Exit code 1 if something is wrong and was not repaired.\nExample: contort corpus fsck contort-out/corpus "
      "--repair");
  command->callback([options, &context] { run_fsck(*options, context); });
}

void add_one(CLI::App& corpus, Context& context, const std::string& name, const char* help,
             Result<Changes> (*run)(const Corpus&)) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = corpus.add_subcommand(name, help);
  command->add_option("CORPUS", *folder, "Corpus folder")->required();
  command->footer("Example: contort corpus " + name + " contort-out/corpus");
  command->callback([folder, run, &context] {
    const Result<Corpus> opened = Corpus::open(*folder);
    if (!opened) return context.fail(opened.issue());
    for (const Issue& issue : left_alone(*opened)) context.fail(issue);  // reported; the other buckets are processed
    const Result<Changes> changes = run(*opened);
    if (!changes) return context.fail(changes.issue(), exit_of(changes.issue()));
    for (const std::string& change : *changes) std::printf("%s\n", printable(change).c_str());
    std::printf("%zu changes\n", changes->size());
  });
}

}  // namespace

void add_upkeep(CLI::App& corpus, Context& context) {
  add_fsck(corpus, context);
  add_one(corpus, context, "rekey", "Rename buckets by the rules of this version", rekey);
  add_one(corpus, context, "prune", "Delete the original cases of fixed buckets", prune);
  add_one(corpus, context, "migrate", "Rewrite buckets and their cases in this version's format", migrate);
}

}  // namespace contort::cli
