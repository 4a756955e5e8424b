// contort fuzz: compose, generate, check, shrink, store.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <thread>

#include "cli/against.h"
#include "cli/case_log.h"
#include "cli/commands.h"
#include "cli/fuzz_totals.h"
#include "cli/input.h"
#include "cli/limits.h"
#include "cli/outputs.h"
#include "cli/print.h"
#include "cli/progress_line.h"
#include "cli/report.h"
#include "cli/report_folder.h"
#include "cli/seeds.h"
#include "cli/surroundings.h"
#include "cli/tested.h"
#include "corpus/leads.h"
#include "corpus/lifecycle.h"
#include "fuzz/run.h"
#include "fuzz/run_state.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/inside_folder.h"
#include "model/core/output.h"

namespace contort::cli {

namespace {

volatile std::sig_atomic_t interrupted = 0;
void on_interrupt(int) { interrupted = 1; }

struct FuzzOptions {
  std::vector<std::string> characters;
  std::int64_t cases = -1;
  std::string time;
  std::int64_t seed = 1;
  int jobs = 0;
  std::string shard;
  std::string profile;
  std::string seeds;
  bool resume = false;
  LimitOptions limits;
  int shrinks_per_family = 2;
  int shrinks_per_case = 4;
  int shrink_evaluations = 2000;
  std::string shrink_time;
  std::string corpus;  // "": contort-out/corpus, or the folder of the pair of builds
  AgainstOptions against;
  double fail_on = 0.0;  // smallest severity of a cause that fails the run
  std::string report;
  std::string log;
  OutputRequest outputs;
  bool json = false;
};

// Prints at most ten times a second.
class RunLine {
 public:
  explicit RunLine(const RunConfig& config) : config_(config) {}
  void show(const RunProgress& p) {
    if (p.elapsed_s < next_s_) return;
    next_s_ = p.elapsed_s + 0.1;
    const double share = config_.cases > 0      ? static_cast<double>(p.cases) / static_cast<double>(config_.cases)
                         : config_.time_s > 0.0 ? p.elapsed_s / config_.time_s
                                                : 0.0;
    std::string text = std::to_string(p.cases) + " cases, " + std::to_string(p.failing) + " failing, " +
                       std::to_string(p.families) + " kinds of failure, " + std::to_string(p.buckets_new) +
                       " new failures, ";
    if (p.shrinking > 0) text += "shrinking " + std::to_string(p.shrinking) + ", ";
    line_.show(share, text + std::to_string(std::lround(p.elapsed_s)) + " s");
  }
  void clear() const { line_.clear(); }

 private:
  const RunConfig& config_;
  ProgressLine line_;
  double next_s_ = 0.0;
};

// The characters of the command line; otherwise of the profile; otherwise all.
Result<DrawConfig> choose_what_is_drawn(const FuzzOptions& options, Generator& generator) {
  DrawConfig draw;
  if (!options.profile.empty()) {
    Result<Profile> profile = load_profile(options.profile);
    if (!profile) return profile.issue();
    draw.profile = std::move(profile).value();
  }
  draw.characters = options.characters.empty() ? draw.profile.characters : options.characters;
  if (draw.characters.empty())
    for (const auto& [name, desc] : generator.manifest().library->characters) draw.characters.push_back(name);
  if (const Result<Done> good = validate(draw.profile, draw.characters, generator); !good)
    return options.profile.empty() ? good.issue() : about_file(options.profile, good.issue());
  for (const std::string& name : draw.characters)
    if (const auto built = build_character({name, {}, {}}, *generator.manifest().library); !built) return built.issue();
  return draw;
}

// Returns 0 for no limit.
Result<double> time_of(const std::string& text) { return text.empty() ? Result<double>(0.0) : parse_time_s(text); }

// The command line takes precedence over the profile.
Result<Done> choose_how_long(const FuzzOptions& options, RunConfig& config) {
  const Profile& profile = config.draw.profile;
  const Result<double> wanted_s = time_of(options.time), profile_s = time_of(profile.time);
  if (!wanted_s) return Issue{wanted_s.issue().code, "", "--time: " + wanted_s.issue().text};
  if (!profile_s) return Issue{"profile.bad_time", "/time", options.profile + ": " + profile_s.issue().text};
  const bool says_nothing = options.cases < 0 && options.time.empty();
  config.time_s = says_nothing ? *profile_s : *wanted_s;
  const bool ends_by_itself = config.time_s > 0.0;
  config.cases = options.cases >= 0 ? options.cases : ends_by_itself ? -1 : profile.cases > 0 ? profile.cases : 2000;
  return Done{};
}

// Seeds are run in addition to drawn cases.
Result<Done> choose_seeds(const FuzzOptions& options, Generator& generator, RunConfig& config) {
  if (options.seeds.empty()) return Done{};
  Result<std::vector<Spec>> seeds = read_seeds(options.seeds, generator);
  if (!seeds) return seeds.issue();
  config.seeds = std::move(seeds).value();
  if (config.cases >= 0) config.cases += std::ssize(config.seeds);
  return Done{};
}

Result<Done> choose_shrinking(const FuzzOptions& options, RunConfig& config) {
  config.shrinks_per_family = options.shrinks_per_family;
  config.shrinks_per_case = options.shrinks_per_case;
  config.shrink.max_evaluations = options.shrink_evaluations;
  if (options.shrink_time.empty()) return Done{};
  const Result<double> time_s = parse_time_s(options.shrink_time);
  if (!time_s) return Issue{time_s.issue().code, "", "--shrink-time: " + time_s.issue().text};
  config.shrink_time_s = *time_s;
  return Done{};
}

Result<Shard> choose_shard(const FuzzOptions& options) {
  // Bazel assumes that a test that does not touch this file does all the work in each shard.
  if (const char* touched = std::getenv("TEST_SHARD_STATUS_FILE"); touched != nullptr)
    if (const Result<Done> done = write_output(touched, ""); !done) return done.issue();
  if (!options.shard.empty()) return parse_shard(options.shard);
  const Result<std::optional<Shard>> said = shard_of_environment([](const char* name) { return std::getenv(name); });
  if (!said) return said.issue();
  return said->value_or(Shard{});
}

Result<RunConfig> configure(const FuzzOptions& options, const CheckSettings& settings, Generator& generator) {
  RunConfig config;
  config.checks = settings;
  Result<DrawConfig> draw = choose_what_is_drawn(options, generator);
  if (!draw) return draw.issue();
  config.draw = std::move(draw).value();
  if (const Result<Done> chosen = choose_how_long(options, config); !chosen) return chosen.issue();
  if (const Result<Done> chosen = choose_seeds(options, generator, config); !chosen) return chosen.issue();
  const Result<Shard> shard = choose_shard(options);
  if (!shard) return shard.issue();
  config.shard = *shard;
  config.resume = options.resume;
  config.limits = options.limits.limits();
  config.seed = options.seed;
  config.jobs = options.jobs > 0 ? options.jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (const Result<Done> chosen = choose_shrinking(options, config); !chosen) return chosen.issue();
  config.tool = CONTORT_VERSION;
  config.generator = program_name(generator.manifest()), config.generator_build = generator.manifest().build;
  return config;
}

// The ids of the run's buckets that gate a build (is_gating).
Result<std::set<std::string>> gating_buckets(const RunResult& result, const std::string& today,
                                             const Baseline& baseline) {
  const GroupCounts now = group_counts_of(std::span(&result.record, 1));
  std::set<std::string> gating;
  for (const std::vector<std::string>* folders : {&result.new_buckets, &result.known_buckets})
    for (const std::string& folder : *folders) {
      const Result<Bucket> bucket = read_bucket(folder);
      if (!bucket) return bucket.issue();
      if (is_gating(*bucket, today, baseline, now)) gating.insert(bucket->id);
    }
  return gating;
}

bool is_any_severe(std::span<const CauseRow> causes, const std::set<std::string>& gating, double least_severity) {
  return std::ranges::any_of(causes, [&](const CauseRow& row) {
    return row.severity >= least_severity && std::ranges::any_of(row.members, [&](const CauseMember& member) {
             return gating.contains(member.bucket.id);
           });
  });
}

bool any_lead_gates(const RunResult& result, const Corpus& corpus, const std::string& today,
                    const Baseline& baseline) {
  const GroupCounts now = group_counts_of(std::span(&result.record, 1));
  std::vector<Issue> damaged;
  const std::set<Family> known = known_families(corpus.buckets(damaged), today, baseline, now);
  return std::ranges::any_of(result.waiting, [&](const std::string& path) {
    const Result<Lead> lead = read_lead(path);
    return lead && !known.contains(family_of(lead->original)) &&
           !may_be_chance(family_of(lead->original), now, baseline);
  });
}

// Returns true if a finding fails the build. A failure that waits to be shrunk has no cause, and so no severity.
Result<bool> any_gates(const RunResult& result, const Corpus& corpus, const FuzzOptions& options,
                       const std::string& today) {
  if (result.record.against) return comparison_gates(result, options.against);
  const Result<Baseline> baseline = load_baseline(options.outputs.baseline);
  if (!baseline) return baseline.issue();
  const Result<std::set<std::string>> gating = gating_buckets(result, today, *baseline);
  if (!gating) return gating.issue();
  if (options.fail_on > 0.0) return is_any_severe(causes_found(result, corpus, *baseline), *gating, options.fail_on);
  return !gating->empty() || any_lead_gates(result, corpus, today, *baseline);
}

int exit_code_of(const RunResult& result, bool gates) {
  const bool is_refused = result.issue.code == "run.busy" || result.issue.code.starts_with("state.");
  if (is_refused || is_untrusted(result.issue)) return kBadInput;
  if (!result.issue.code.empty()) return kInternal;
  if (result.interrupted) return kInterrupted;
  if (!result.unconfirmed.empty() || result.record.discarded > 0 || compared_nothing(result)) return kInconclusive;
  return gates ? kFindings : kClean;
}

// --resume after a new build, or with other options, begins another run. This warns if the corpus has the state of one.
void warn_of_other_states(const RunConfig& config, const Corpus& corpus) {
  namespace fs = std::filesystem;
  RunRecord record;
  record.name = run_name(config), record.shard = config.shard.index, record.shards = config.shard.count;
  std::error_code error;
  if (!config.resume || fs::exists(state_path(corpus, record), error)) return;
  const std::string of_seed = "seed_" + std::to_string(config.seed) + "_";
  std::set<std::string> others;
  for (const auto& entry : fs::directory_iterator(corpus.folder() + "/runs", error)) {
    const std::string name = entry.path().stem();  // the name may have a shard after a dot
    const bool is_running = fs::exists(fs::path(entry.path()).replace_extension(".lock"), error);
    const bool is_other = name.starts_with(of_seed) && name.substr(0, name.find('.')) != record.name;
    if (entry.path().extension() == ".state" && is_other && !is_running) others.insert(name);
  }
  for (const std::string& other : others)
    std::fprintf(
        stderr,
        "contort: %s was stopped, and this is %s: another build, library, profile or settings; it begins anew\n",
        printable(other).c_str(), record_name(record).c_str());
}

// Checks the outputs now, not after an hour of work.
Result<Done> check_results(const FuzzOptions& options) {
  if (const Result<Done> writable = check_outputs(options.outputs); !writable) return writable;
  return options.report.empty() ? Result<Done>(Done{}) : check_report_folder(options.report);
}

// Each pair of builds has a corpus of its own.
Result<Corpus> open_corpus(const FuzzOptions& options, const RunConfig& config) {
  Result<Corpus> corpus = Corpus::create(options.corpus);
  if (!corpus) return corpus;
  if (const Result<Done> fits = check_pair(*corpus, config.against); !fits) return fits.issue();
  return corpus;
}

// A program under test may refuse requests that its manifest allows, which wastes time. Our own generator must not.
void tell_discarded(const RunRecord& record, bool of_program) {
  const auto count = static_cast<long long>(record.discarded);
  if (of_program)
    std::fprintf(stderr, "contort: the generator refused %lld of %lld requests that its manifest allows, so that they "
                         "were not judged\n", count, static_cast<long long>(record.cases));
  else
    std::fprintf(stderr, "contort: %lld drawn specs did not build; that is a fault of the fuzzer\n", count);
}

// Cases of two generators must not be mixed in one corpus.
std::string corpus_of_generator(const std::string& name) {
  return name.empty() ? "contort-out/corpus" : "contort-out/program-" + content_id(name).substr(0, 8);
}

void run(FuzzOptions options, Context& context) {
  std::signal(SIGINT, on_interrupt);  // first of all, so that an interrupted run always ends properly
  std::signal(SIGTERM, on_interrupt);
  take_limits(options.limits, context.sources);
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  if (options.profile.empty() && !context.sources.generator.empty()) options.profile = "guest";
  const Result<CheckSettings> settings = context.load_settings();
  if (!settings) return context.fail(settings.issue());
  Result<RunConfig> configured = configure(options, *settings, *generator);
  if (!configured) return context.fail(configured.issue());
  RunConfig config = std::move(configured).value();
  config.surroundings = surroundings_id(context, generator->manifest());
  Result<std::optional<AgainstConfig>> base = choose_base(options.against, config.limits, context);
  if (!base) return context.fail(base.issue());
  config.against = std::move(base).value();
  if (options.corpus.empty())
    options.corpus = config.against ? folder_of_pair(*config.against) : corpus_of_generator(config.generator);
  if (const Result<Done> ready = check_results(options); !ready)
    return context.fail(ready.issue(), exit_of(ready.issue()));
  // Reads the baseline now, not after an hour of fuzzing, to report errors. It is read again at the end, because other
  // programs may have changed it.
  const Result<Baseline> known = load_baseline(options.outputs.baseline);
  if (!known) return context.fail(known.issue());
  const Result<Corpus> corpus = open_corpus(options, config);
  if (!corpus) return context.fail(corpus.issue(), exit_of(corpus.issue()));
  warn_of_other_rules(*corpus);
  warn_of_other_states(config, *corpus);
  Result<CaseLog> opened = CaseLog::open(options.log, options.resume);
  if (!opened) return context.fail(opened.issue());
  CaseLog log = std::move(opened).value();
  RunLine line(config);
  const RunResult result = run_fuzz(
      config, *generator, *corpus, [&](const RunProgress& p) { line.show(p); }, [] { return interrupted != 0; },
      log.listener());
  line.clear();
  const Result<bool> gates = any_gates(result, *corpus, options, context.day());
  if (!gates) context.fail(gates.issue());
  const int code = exit_code_of(result, !gates || *gates);
  context.exit_code = code;
  print_totals(result, {options.json, options.corpus, options.report, options.shrinks_per_case, *settings,
                        context.sources, config.against, *known});
  if (!result.issue.code.empty()) context.fail(result.issue, static_cast<Exit>(code));
  if (const Result<Done> closed = log.close(); !closed) context.fail(closed.issue(), kInternal);
  if (result.record.discarded > 0) tell_discarded(result.record, !context.sources.generator.empty());
  if (!options.report.empty() || options.outputs.wanted())
    make_report({options.corpus, options.report, "", !options.json, options.outputs}, *generator, context);
  if (!options.json) print_result(result);
}

std::string profile_names() {
  std::string names;
  for (const Profile& profile : built_in_profiles()) names += (names.empty() ? "" : ", ") + profile.name;
  return names;
}

}  // namespace

void add_fuzz(CLI::App& app, Context& context) {
  auto options = std::make_shared<FuzzOptions>();
  CLI::App* command =
      app.add_subcommand("fuzz", "Compose random motions, check every frame, shrink and store what fails");
  command->add_option("--character", options->characters, "Character to fuzz; may be repeated (default: all)");
  command->add_option("--cases", options->cases, "Stop after this number of cases (default: 2000, or no limit with --time)")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53));
  command->add_option("--time", options->time, "Stop after this time: 45s, 1.5m, 2h; without a unit, seconds");
  command->add_option("--seed", options->seed, "Case i depends only on the seed and on i")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53))
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Worker processes (default: one per core)")->check(CLI::Range(1, 1024));
  command->add_option("--profile", options->profile,
                      "Profile that says what is drawn: " + profile_names() + ", or a file (contort schema profile)");
  command->add_option("--seeds", options->seeds,
                      "Folder of specs and cases (*.json) that run before the drawn cases, in addition to --cases");
  command->add_option(
      "--shard", options->shard,
      "Run share K of N, counted from 0: 3/16 (default: from the variables GTEST_, TEST_, SLURM_ARRAY_, "
      "JOB_COMPLETION_ or CI_NODE_ of a scheduler)");
  command->add_flag("--resume", options->resume, "Continue a run with the same options that was stopped");
  add_limit_options(*command, options->limits);
  command
      ->add_option("--shrinks-per-family", options->shrinks_per_family,
                   "Number of failures of one kind that are shrunk and stored")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--shrinks-per-case", options->shrinks_per_case,
                   "Number of kinds of failure of one case that are shrunk and stored, the earliest first; others are counted")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command
      ->add_option("--shrink-evaluations", options->shrink_evaluations,
                   "Greatest number of motions generated for each shrink")
      ->check(CLI::Range(0, 36000))
      ->capture_default_str();
  command->add_option("--shrink-time", options->shrink_time,
                      "Stop each shrink after this time: 45s, 1.5m; results then depend on the machine");
  command->add_option("--corpus", options->corpus, "Folder in which failures are stored")
      ->default_str("contort-out/corpus");
  add_against_options(*command, options->against);
  command->add_option("--report", options->report, "Write an HTML report into this folder afterwards");
  command->add_option("--log", options->log, "Write every failing case as a line of JSON: index, arm, families, spec");
  add_output_options(*command, options->outputs);
  command
      ->add_option(
          "--fail-on", options->fail_on,
          "Exit with 1 only for a cause of at least this severity (0 to 100) that is not in the baseline and that "
          "nobody has acknowledged (docs/reference/causes.md); 0: for any failure")
      ->check(CLI::Range(0.0, 100.0))
      ->check(refuse_nan)
      ->excludes("--against")
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer("Example: contort fuzz --character mech --time 10m --seed 7 --report contort-out/report");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
