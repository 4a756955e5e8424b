// contort shrink: finds a smaller spec with the same failure.
#include "fuzz/shrink.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <optional>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/measured_values.h"
#include "cli/print.h"
#include "cli/tested.h"
#include "corpus/corpus.h"
#include "corpus/guarded_replay.h"
#include "fuzz/profile_violations.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"
#include "model/core/output.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

struct ShrinkOptions {
  std::string input;
  std::string output;
  std::string worst;
  std::string time;
  std::string profile;
  bool json = false;
  ShrinkConfig config;
};

// The case as it fails now. If it does not fail, the reason is printed, and nothing is returned.
std::optional<Case> failing_now(const ShrinkOptions& options, Generator& generator, const CheckSettings& settings,
                                Context& context) {
  Result<Case> stored = read_case_input(options.input);
  if (!stored) return context.fail(stored.issue()), std::nullopt;
  Evaluator evaluator(generator, settings);
  GuardedReplay guarded([&](const Case& c) { return replay(c, evaluator); }, {});
  if (const Result<Done> same = check_generator(*stored, generator.manifest()); !same)
    return context.fail(about_file(options.input, same.issue())), std::nullopt;
  const Replay now = guarded(*stored);
  if (now.verdict == Verdict::refused) return context.fail(about_file(options.input, now.issue)), std::nullopt;
  if (now.verdict != Verdict::same && now.verdict != Verdict::same_family)
    return context.fail(
               {"shrink.no_failure", "",
                options.input + " does not fail as stored any more (" + std::string(verdict_name(now.verdict)) + ")"}),
           std::nullopt;
  Case failing = std::move(stored).value();
  failing.expect = now.now;
  return failing;
}

// The profile within which it must stay: that of the command line; otherwise the built-in one that found the case;
// otherwise none.
Result<std::optional<Profile>> profile_of(const ShrinkOptions& options, const Case& original) {
  const std::string& found_with = original.provenance.profile;
  if (!options.profile.empty()) {
    Result<Profile> profile = load_profile(options.profile);
    if (!profile) return profile.issue();
    return std::optional(std::move(profile).value());
  }
  for (const Profile& profile : built_in_profiles())
    if (profile.name == found_with) return std::optional(profile);
  if (!found_with.empty())
    std::fprintf(stderr, "contort: it was found with the profile %s; --profile FILE stays within that\n",
                 json_fields::quoted(found_with).c_str());
  return std::optional<Profile>();
}

// The configuration of one shrink; its time runs from now on.
Result<ShrinkConfig> configure(const ShrinkOptions& options, const CheckSettings& settings) {
  ShrinkConfig config = options.config;
  config.checks = settings;
  config.guarded = true;  // candidates may end their processes, but not the user's
  if (options.time.empty()) return config;
  const Result<double> seconds = parse_time_s(options.time);
  if (!seconds) return Issue{seconds.issue().code, "", "--time: " + seconds.issue().text};
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(*seconds);
  config.out_of_time = [end] { return std::chrono::steady_clock::now() >= end; };
  return config;
}

void print_shrunk(const Shrunk& shrunk, const Case& original, const std::string& output, MeasuredValues values,
                  const Context& context) {
  std::printf("%s: %zu bytes of spec, was %zu (%d evaluations, %s)\n", output.c_str(),
              print_spec(shrunk.minimal.spec).size(), print_spec(original.spec).size(), shrunk.evaluations,
              shrunk.stopped.c_str());
  for (const std::string& pointer : shrunk.minimal.free_fields) std::printf("any value: %s\n", pointer.c_str());
  if (shrunk.worst.expect.depth > shrunk.minimal.expect.depth)
    std::printf("worst: %s; here: %s\n", values.sentence_of(shrunk.worst).c_str(),
                values.sentence_of(shrunk.minimal).c_str());
  for (const Family& other : shrunk.minimal.co_failures) std::printf("comes with it: %s\n", print_family(other).c_str());
  if (shrunk.precursor) std::printf("a run files it under: %s\n", print_family(family_of(*shrunk.precursor)).c_str());
  for (const Case& other : shrunk.met) std::printf("also met: %s\n", print_family(family_of(other)).c_str());
  std::printf("%s\n", replay_command(output, context.sources).c_str());
}

void print_json(const Shrunk& shrunk, const std::string& output) {
  json_fields::Json also = json_fields::Json::array(), met = json_fields::Json::array();
  for (const Family& other : shrunk.minimal.co_failures) also.push_back(print_family(other));
  for (const Case& other : shrunk.met) met.push_back(print_family(family_of(other)));
  const json_fields::Json out = {
      {"case", output},
      {"family", print_family(family_of(shrunk.minimal))},
      {"stopped", shrunk.stopped},
      {"evaluations", shrunk.evaluations},
      {"depth", shrunk.minimal.expect.depth},
      {"worst_depth", shrunk.worst.expect.depth},
      {"free_fields", shrunk.minimal.free_fields},
      {"also", also},
      {"precursor", shrunk.precursor ? json_fields::Json(print_family(family_of(*shrunk.precursor))) : nullptr},
      {"met", met}};
  std::printf("%s\n", out.dump(2, ' ', false, json_fields::Json::error_handler_t::replace).c_str());
}

void run(const ShrinkOptions& options, Context& context) {
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<CheckSettings> settings = context.load_settings_without_waivers();
  if (!settings) return context.fail(settings.issue());
  const Result<ShrinkConfig> configured = configure(options, *settings);
  if (!configured) return context.fail(configured.issue());
  const std::optional<Case> original = failing_now(options, *generator, *settings, context);
  if (!original) return;
  const Result<std::optional<Profile>> profile = profile_of(options, *original);
  if (!profile) return context.fail(profile.issue());
  ShrinkConfig config = *configured;
  if (*profile) config.allowed = within(**profile, original->spec, *generator);
  const Shrunk shrunk = shrink(*original, *generator, config);
  if (shrunk.stopped == "flaky" || shrunk.stopped == "gone")
    return context.fail({"shrink.flaky", "", options.input + " gives another result each time: nothing is shrunk"},
                        kInconclusive);
  const std::string output =
      options.output.empty() ? "min-" + spec_id(shrunk.minimal.spec).substr(0, 16) + ".json" : options.output;
  if (const Result<Done> written = write_output(output, print_case(shrunk.minimal)); !written)
    return context.fail(written.issue(), kInternal);
  if (!options.worst.empty())
    if (const Result<Done> written = write_output(options.worst, print_case(shrunk.worst)); !written)
      return context.fail(written.issue(), kInternal);
  if (options.json) return print_json(shrunk, output);
  print_shrunk(shrunk, *original, output, MeasuredValues(*generator->manifest().library, *settings), context);
}

}  // namespace

void add_shrink(CLI::App& app, Context& context) {
  auto options = std::make_shared<ShrinkOptions>();
  CLI::App* command = app.add_subcommand("shrink", "Make a case smaller, with the same failure");
  command->add_option("CASE", options->input, "Case file")->required();
  command->add_option("-o,--output", options->output, "File to write (default: min-<id>.json in this folder)");
  command->add_option("--worst", options->worst, "Also write, to this file, the deepest failure that the smaller case shows with other numbers");
  command->add_option("--time,--shrink-time", options->time,
                      "Stop after this time: 45s, 1.5m; without a unit, seconds; results then depend on the machine");
  command->add_option("--profile", options->profile,
                      "Stay within this profile, a name or a file (default: the built-in profile that found the case)");
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->add_option("--evaluations", options->config.max_evaluations, "Greatest number of motions to generate")
      ->check(CLI::Range(0, 36000))
      ->capture_default_str();
  command
      ->add_option("--depth-floor", options->config.depth_floor,
                   "Keep at least this fraction of the depth; 0: any depth")
      ->check(CLI::Range(0.0, 1.0))
      ->check(refuse_nan)
      ->capture_default_str();
  command->footer(
      "Example: contort shrink contort-out/corpus/buckets/joint_range-0123456789ab/orig-0123456789abcdef.json -o "
      "small.json");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
