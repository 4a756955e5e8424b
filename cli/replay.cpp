// contort replay: replays a stored case and compares the result with the stored one; for a corpus, updates each bucket.
#include "corpus/replay.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/limits.h"
#include "cli/measured_values.h"
#include "cli/outputs.h"
#include "cli/print.h"
#include "cli/replay_text.h"
#include "cli/side_by_side.h"
#include "cli/tested.h"
#include "corpus/corpus.h"
#include "corpus/guarded_replay.h"
#include "corpus/verify.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

using json_fields::Json;
using Clock = std::chrono::steady_clock;

struct ReplayOptions {
  std::vector<std::string> paths;
  bool json = false;
  std::string against;  // another program to compare with; "": none
  std::string level;
  bool update = false;
  std::string time;
  std::string build;
  std::string baseline;
  LimitOptions limits;
};

Json as_json(const std::string& path, const Family& family, const Replay& result) {
  Json out = {{"case", path},
              {"family", print_family(family)},
              {"verdict", verdict_name(result.verdict)},
              {"character_changed", result.character_changed},
              {"motion_hash", result.now.motion_hash}};
  if (result.first_difference >= 0) out["first_differing_frame"] = result.first_difference;
  if (result.verdict == Verdict::refused) out["issue"] = to_line(result.issue);
  return out;
}

// A case that fails as before is expected; every change needs attention.
int exit_code_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
    case Verdict::same_family: return kFindings;
    case Verdict::different: return kFindings;
    case Verdict::passes: return kClean;
    case Verdict::refused: return kBadInput;
  }
  return kInternal;
}

// A replay gates if the bucket still fails, in any way, and is not known.
bool gates(const BucketReplay& ran, const Bucket& next, const std::string& today, const Baseline& known) {
  const bool fails = ran.shown == Shown::fails || (ran.shown == Shown::gone && ran.verdict == Verdict::different);
  return fails && is_gating(next, today, known, {});
}

struct Totals {
  std::map<Verdict, int> verdicts;  // verdicts of cases
  int cases = 0;
  int buckets = 0;
  std::map<Outcome, int> files, failures;  // case files given by themselves, and buckets of corpora
  std::map<BucketState, int> states;  // states of buckets, afterwards
  int gating = 0;
  int skipped = 0;  // buckets that were skipped because time was up
  int stale = 0;    // quarantines that always pass
};

// One call of the command.
class ReplayCommand {
 public:
  ReplayCommand(const ReplayOptions& options, RunCase replay, const Manifest& manifest, MeasuredValues values,
                Context& context)
      : options_(options),
        replay_(std::move(replay), options.limits.limits()),
        manifest_(manifest),
        values_(std::move(values)),
        context_(context) {}

  Result<Done> prepare() {
    const Result<Baseline> known = load_baseline(options_.baseline);
    if (!known) return known.issue();
    known_ = *known;
    if (options_.time.empty()) return Done{};
    const Result<double> time_s = parse_time_s(options_.time);
    if (!time_s) return Issue{time_s.issue().code, "", "--time: " + time_s.issue().text};
    end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*time_s));
    return Done{};
  }

  void run_case(const std::string& path) {
    ++totals_.cases;
    const Result<Case> stored = read_case_input(path);
    if (!stored) {
      context_.fail(stored.issue());
      count_file(Verdict::refused);
      return;
    }
    if (const Result<Done> same = check_generator(*stored, manifest_); !same) {
      context_.fail(about_file(path, same.issue()));
      count_file(Verdict::refused);
      return;
    }
    const Replay result = replay_(*stored);
    count_file(result.verdict);
    raise(exit_code_of(result.verdict));
    if (options_.json)
      list_.push_back(as_json(path, family_of(*stored), result));
    else
      std::printf("%-17s  %s  %s\n", outcome_words(cli::outcome_of(result.verdict)).c_str(), path.c_str(),
                  printable(case_text(*stored, result, values_) + change_of_build(*stored)).c_str());
  }

  void run_corpus(const std::string& folder) {
    const Result<Corpus> corpus = Corpus::open(folder);
    if (!corpus) return context_.fail(corpus.issue());
    if (const Result<Done> same = check_generator(*corpus, manifest_); !same) return context_.fail(same.issue());
    has_corpus_ = true;
    std::vector<Issue> damaged;
    const std::vector<Bucket> buckets = corpus->buckets(damaged);
    for (const Issue& issue : damaged) context_.fail(issue);
    for (const Bucket& bucket : end_ ? replay_order_of_day(buckets, context_.day()) : replay_order(buckets)) {
      if (end_ && Clock::now() >= *end_ && may_skip(bucket))
        ++totals_.skipped;
      else
        run_bucket(*corpus, bucket);
    }
  }

  void finish() {
    if (unwritten_ > 1) std::fprintf(stderr, "contort: %d more failures could not be updated\n", unwritten_ - 1);
    if (options_.json) {
      std::printf("%s\n", list_.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
      return;
    }
    print_tallies();
    const auto verdicts = [&](Verdict verdict) { return totals_.verdicts[verdict]; };
    std::printf("RESULT cases=%d same=%d same_family=%d different=%d passes=%d refused=%d", totals_.cases,
                verdicts(Verdict::same), verdicts(Verdict::same_family), verdicts(Verdict::different),
                verdicts(Verdict::passes), verdicts(Verdict::refused));
    if (has_corpus_)
      std::printf(" buckets=%d gating=%d regressed=%d fixed=%d flaky=%d stale=%d skipped=%d", totals_.buckets,
                  totals_.gating, totals_.states[BucketState::regressed], totals_.states[BucketState::fixed],
                  totals_.states[BucketState::flaky], totals_.stale, totals_.skipped);
    std::printf("\n");
  }

 private:
  void count_file(Verdict verdict) {
    ++totals_.verdicts[verdict];
    ++totals_.files[cli::outcome_of(verdict)];
  }

  // Prints all verdicts in one sentence. A single case has its verdict in its line already.
  void print_tallies() const {
    int files = 0;
    for (const auto& [outcome, count] : totals_.files) files += count;
    if (files > 1) std::printf("%s: %s.\n", counted(files, "case", "cases").c_str(), tally_text(totals_.files).c_str());
    if (!has_corpus_) return;
    std::string text = counted(totals_.buckets, "stored failure", "stored failures");
    if (totals_.buckets > 0)
      text += " in " + counted(totals_.cases - files, "case", "cases") + ": " + tally_text(totals_.failures);
    text += "; " + counted(totals_.gating, "fails", "fail") + " the build";
    if (totals_.skipped > 0) text += "; the time was up before " + counted(totals_.skipped, "other", "others");
    std::printf("%s.\n", text.c_str());
  }

  std::string change_of_build(const Case& stored) const {
    const std::string& before = stored.provenance.generator_build;
    if (before.empty() || before == manifest_.build) return "";
    return ", the generator has changed from build " + before + " to " + manifest_.build;
  }

  // Bad input takes precedence over findings, and findings over unsteady replays.
  void raise(int code) {
    const auto weight = [](int c) { return c == kInternal ? 4 : c == kBadInput ? 3 : c == kFindings ? 2 : c != 0; };
    if (weight(code) > weight(context_.exit_code)) context_.exit_code = code;
  }

  void run_bucket(const Corpus& corpus, const Bucket& bucket) {
    const BucketReplay ran = replay_bucket(corpus, bucket, [&](const Case& c) { return replay_(c); });
    const Observation seen{ran.shown,
                           "contort " CONTORT_VERSION + (options_.build.empty() ? "" : " " + options_.build)};
    const auto change = [&](const Bucket& now) -> Result<Bucket> { return next_state(now, seen, context_.day()); };
    Result<Bucket> next = options_.update ? corpus.change(bucket, change) : change(bucket);
    // The first bucket prints the reason; results are still printed.
    if (!next && next.issue().code == "file.unwritable") {
      if (++unwritten_ == 1) context_.fail(next.issue(), kInternal);
      next = change(bucket);
    }
    if (!next) return context_.fail(next.issue());
    count(ran, *next);
    if (options_.json)
      list_.push_back(bucket_json(ran, *next));
    else
      print_bucket_line(corpus, ran, *next);
  }

  void count(const BucketReplay& ran, const Bucket& next) {
    ++totals_.buckets;
    totals_.cases += static_cast<int>(ran.cases.size());
    for (const CaseReplay& one : ran.cases) ++totals_.verdicts[one.result.verdict];
    ++totals_.states[next.state];
    ++totals_.failures[outcome_of(ran)];
    totals_.stale += is_stale(next) ? 1 : 0;
    const bool gating = gates(ran, next, context_.day(), known_);
    totals_.gating += gating ? 1 : 0;
    if (gating) raise(kFindings);
    const bool changed = next.state != ran.bucket.state;
    if (changed && next.state == BucketState::invalid) raise(kBadInput);
    if (changed && next.state == BucketState::flaky) raise(kInconclusive);
  }

  // The most informative case: the first one with the bucket's verdict.
  static const CaseReplay* shown_case(const BucketReplay& ran) {
    for (const CaseReplay& one : ran.cases)
      if (one.result.verdict == ran.verdict) return &one;
    return nullptr;
  }

  static Outcome outcome_of(const BucketReplay& ran) {
    return ran.shown == Shown::unsteady ? Outcome::unsteady : cli::outcome_of(ran.verdict);
  }

  // The bucket's headline; or its check and subject if its minimal case cannot be read.
  static std::string name_of(const Corpus& corpus, Bucket bucket) {
    if (const Result<Case> minimal = corpus.minimal_of(bucket); minimal) return failure_text(*minimal);
    return failure_in_words(bucket.family.check, bucket.family.subject) + " (" + bucket.family.character + ")";
  }

  std::string news_of(const BucketReplay& ran, const Bucket& next) const {
    std::string text = state_text(ran.bucket.state, next.state);
    if (gates(ran, next, context_.day(), known_)) text += ", fails the build";
    if (is_expired(ran.bucket, context_.day())) text += ", the quarantine is over";
    if (is_stale(next)) text += ", passes every time: the quarantine is needed no more";
    return text;
  }

  void print_bucket_line(const Corpus& corpus, const BucketReplay& ran, const Bucket& next) {
    std::string text = news_of(ran, next) + "  " + name_of(corpus, ran.bucket);
    if (const CaseReplay* one = shown_case(ran)) {
      text += change_text(one->result);
      if (one->result.verdict == Verdict::refused) text += "  " + to_line(one->result.issue);
      if (const Result<Case> stored = read_case_input(one->path); stored) text += change_of_build(*stored);
      text += "  " + replay_command(one->path, context_.sources);
    }
    std::printf("%-17s  %s  %s\n", outcome_words(outcome_of(ran)).c_str(), folder_name(ran.bucket).c_str(),
                printable(text).c_str());
  }

  Json bucket_json(const BucketReplay& ran, const Bucket& next) {
    Json cases = Json::array();
    for (const CaseReplay& one : ran.cases) cases.push_back(as_json(one.path, one.family, one.result));
    return {{"bucket", folder_name(ran.bucket)},
            {"family", print_family(ran.bucket.family)},
            {"verdict", ran.shown == Shown::unsteady ? "unsteady" : verdict_name(ran.verdict)},
            {"state", state_name(ran.bucket.state)},
            {"next_state", state_name(next.state)},
            {"gating", gates(ran, next, context_.day(), known_)},
            {"cases", cases}};
  }

  const ReplayOptions& options_;
  GuardedReplay replay_;
  const Manifest& manifest_;
  MeasuredValues values_;
  Context& context_;
  Baseline known_;
  std::optional<Clock::time_point> end_;
  bool has_corpus_ = false;
  int unwritten_ = 0;  // buckets that --update could not write
  Totals totals_;
  Json list_ = Json::array();
};

void run(const ReplayOptions& options, Context& context) {
  take_limits(options.limits, context.sources);
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<CheckSettings> settings = context.load_settings_without_waivers();
  if (!settings) return context.fail(settings.issue());
  const Result<ReplayScope> scope =
      options.level.empty() ? Result<ReplayScope>(ReplayScope{}) : parse_scope(options.level);
  if (!scope) return context.fail(scope.issue());
  if (!options.against.empty()) return replay_side_by_side(options.paths, options.against, *generator, context);
  Evaluator evaluator(*generator, *settings);
  const auto replay_one = [&](const Case& stored) {
    return replay(stored, evaluator, *scope, isolation_of(options.limits.limits()));
  };
  ReplayCommand replays(options, replay_one, generator->manifest(),
                        MeasuredValues(*generator->manifest().library, *settings), context);
  if (const Result<Done> ready = replays.prepare(); !ready) return context.fail(ready.issue());
  for (const std::string& path : options.paths) {
    std::error_code error;
    const bool is_folder = std::filesystem::is_directory(path, error);
    if (is_folder && !options.level.empty())
      return context.fail({"usage", "", "--level is for case files, and " + path + " is a folder"});
    if (is_folder)
      replays.run_corpus(path);
    else
      replays.run_case(path);
  }
  replays.finish();
}

}  // namespace

void add_replay(CLI::App& app, Context& context) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand("replay", "Run stored cases again and compare with the stored results");
  command->add_option("CASE", options->paths, "Case files, or corpus folders")->required();
  add_level_option(*command, options->level);
  command
      ->add_option("--against", options->against,
                   "With --generator: also run this program, and say from which frame on its motions differ")
      ->type_name("CMD");
  command->add_flag("--update", options->update, "For a corpus: write the new states of its failures into it");
  command->add_option("--time", options->time,
                      "For a corpus: stop after this time: 45s, 1.5m, 2h; without a unit, seconds");
  command->add_option("--build", options->build,
                      "Text that names the build after the version, such as a commit of your library; for --update");
  add_limit_options(*command, options->limits);
  add_baseline_option(*command, options->baseline);
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer(
      "Each line begins with what became of a case or failure: still fails, fails differently, passes now, cannot\n"
      "run, runs differ. Exit code for case files: 1 if one still fails, 0 if all pass. For a corpus: 1 if a failure\n"
      "fails the build: it is new, has regressed, or its quarantine is over (docs/reference/corpus.md).\n"
      "Example: contort replay contort-out/corpus\n"
      "         contort replay CASE --level part:arm_right");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
