// contort shrink: a smaller spec with the same failure.
#include "fuzz/shrink.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/commands.h"
#include "cli/input.h"
#include "corpus/corpus.h"
#include "corpus/replay.h"
#include "generator/core/files.h"

namespace contort::cli {

namespace {

struct Options {
  std::string input;
  std::string output;
  ShrinkConfig config;
};

void run(const Options& options, Context& context) {
  const Library* library = context.load_library();
  if (library == nullptr) return;
  Result<Case> stored = read_case(options.input);
  if (!stored) return context.fail(stored.issue());
  Result<CheckSettings> settings = context.load_settings();
  if (!settings) return context.fail(settings.issue());
  CheckSettings without_waivers = std::move(settings).value();
  without_waivers.waivers.clear();  // what is waived is still there
  Evaluator evaluator(without_waivers);
  const Replay now = replay(*stored, *library, evaluator);
  if (now.verdict == Verdict::refused) return context.fail(now.issue);
  if (now.verdict != Verdict::same && now.verdict != Verdict::same_family)
    return context.fail(
        {"shrink.no_failure", "",
         options.input + " does not fail as it says any more (" + std::string(verdict_name(now.verdict)) + ")"});
  Case original = std::move(stored).value();
  original.expect = now.now;
  ShrinkConfig config = options.config;
  config.checks = without_waivers;
  const Case smaller = shrink(original, *library, config);
  const std::string output =
      options.output.empty() ? "min-" + spec_id(smaller.spec).substr(0, 16) + ".json" : options.output;
  if (const Result<Done> written = write_file(output, print_case(smaller)); !written)
    return context.fail(written.issue(), kInternal);
  std::printf("%s: %zu bytes of spec, was %zu (%d evaluations, %s)\n", output.c_str(), print_spec(smaller.spec).size(),
              print_spec(original.spec).size(), smaller.provenance.shrink_evaluations,
              smaller.provenance.shrink_stopped.c_str());
  std::printf("%s\n", replay_command(output, context.library_folders).c_str());
}

}  // namespace

void add_shrink(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("shrink", "Make a case smaller, with the same failure");
  command->add_option("CASE", options->input, "Case file")->required();
  command->add_option("-o,--output", options->output, "Where to write it (default: min-<id>.json here)");
  command->add_option("--evaluations", options->config.max_evaluations, "Motions generated, at most")
      ->check(CLI::Range(0, 36000))
      ->capture_default_str();
  command->add_option("--depth-floor", options->config.depth_floor, "Stay at least this share of the depth")
      ->check(CLI::Range(0.0, 1.0))
      ->check(refuse_nan)
      ->capture_default_str();
  command->footer(
      "Example: contort shrink contort-out/corpus/buckets/joint_range-0123456789ab/orig-0123456789abcdef.json -o "
      "small.json");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
