#include "fuzz/run.h"

#include <algorithm>

#include "corpus/half_written.h"
#include "corpus/leads.h"
#include "fuzz/case_work.h"
#include "fuzz/compose.h"
#include "fuzz/crew.h"
#include "fuzz/failure_queue.h"
#include "fuzz/round.h"
#include "fuzz/run_state.h"
#include "fuzz/run_statistics.h"
#include "fuzz/time_budget.h"
#include "model/core/hash.h"
#include "process/clock.h"

namespace contort {

namespace {

std::string plan_of(const RunConfig& config) {
  return run_name(config) + " shrinks=" + std::to_string(config.shrinks_per_family) +
         " of_case=" + std::to_string(config.shrinks_per_case) +
         " evaluations=" + std::to_string(config.shrink.max_evaluations) +
         " shrink_time=" + std::to_string(config.shrink_time_s);
}

RunState fresh_state(const RunConfig& config) {
  RunState state;
  state.plan = plan_of(config);
  state.record.name = run_name(config);
  state.record.tool = config.tool;
  state.record.shrinks_per_family = config.shrinks_per_family;
  state.record.shard = config.shard.index, state.record.shards = config.shard.count;
  if (config.against) state.record.against.emplace().base = config.against->base;
  if (config.against) state.record.against->build = config.against->build;
  return state;
}

// The callbacks of a run.
struct Listeners {
  const std::function<void(const RunProgress&)>& progress;
  const std::function<bool()>& stop;
  const std::function<void(const FailingCase&)>& failing;
};

class Run {
 public:
  Run(const RunConfig& config, Generator& generator, const Corpus& corpus, const Listeners& listeners)
      : config_(config), generator_(generator), corpus_(corpus), listeners_(listeners), state_(fresh_state(config)) {
    config_.deadline_s = time_.deadline_s();
  }

  RunResult run() {
    const Result<RunLock> lock = RunLock::take(corpus_, state_.record);
    if (!lock) return result_.issue = lock.issue(), std::move(result_);
    if (config_.resume) resume();
    if (config_.shard.count == 1) failures_.find_waiting();
    if (ok()) search();
    finish();
    return std::move(result_);
  }

 private:
  bool ok() const { return result_.issue.code.empty() && failures_.issue().code.empty(); }
  bool is_last(std::int64_t index) const { return config_.cases >= 0 && index >= config_.cases; }
  bool has_time_for_waiting() const { return time_.has_time_for_waiting(steady_s()); }
  bool halted() {
    if (listeners_.stop()) result_.interrupted = true;
    return result_.interrupted || time_.is_over(steady_s()) || !ok();
  }
  bool must_fold() { return halted() || (time_.must_fold(steady_s()) && round_.has_failure()); }

  void resume() {
    Result<std::optional<RunState>> kept = load_state(corpus_, state_.record, state_.plan);
    if (!kept) return fail(kept.issue());
    if (kept->has_value()) state_ = std::move(**kept);
    failures_.go_on();
  }

  void search() {
    Crew crew(config_.jobs, config_.limits, CaseWork(config_, generator_, corpus_));
    while (!is_last(state_.next) && !halted() && !is_cut_) {
      begin_round();
      while (!round_.is_whole() && !(must_fold() && !crew.is_any_case_running())) step(crew, !must_fold());
      fold_round();
      round_ = Round(config_.against.has_value());
      keep_state_sometimes();
    }
    settle_the_rest(crew);
  }

  // All cases have run. Once time is up, the remaining failures are only stored; another run on this corpus shrinks
  // them.
  void settle_the_rest(Crew& crew) {
    while (ok() && !result_.interrupted && (crew.busy() > 0 || !failures_.is_done(has_time_for_waiting()))) {
      if (listeners_.stop()) result_.interrupted = true;
      if (time_.is_over(steady_s())) failures_.only_keep();
      step(crew, true);
    }
  }

  void begin_round() {
    for (std::int64_t index = state_.next; index < state_.next + kRound && !is_last(index); ++index) {
      const int island = island_of(index);
      if (!is_of(config_.shard, island)) continue;
      round_.add(is_seed(config_, index) ? Lineage{index} : lineage_of(static_cast<std::size_t>(island), index));
    }
    time_.begin_round(steady_s());
  }

  Lineage lineage_of(std::size_t island, std::int64_t index) const {
    return odds_.staged ? state_.ingredients[island].lineage_of(odds_.seed, index)
                        : state_.islands[island].lineage_of(odds_, index);
  }

  void step(Crew& crew, bool hand_out) {
    while (hand_out && crew.has_idle()) {
      const std::optional<Job> job = next_job();
      if (!job) break;
      crew.give(*job);
    }
    if (const std::optional<Crew::Finished> finished = crew.wait(100)) take(*finished);
    report();
  }

  // Failures go before new cases, so that findings reach the user soon.
  std::optional<Job> next_job() {
    if (const std::optional<FailureJob> failure = failures_.next(has_time_for_waiting())) return *failure;
    if (const std::optional<int> place = round_.next()) return PlacedCase{*place, round_.task(*place)};
    return std::nullopt;
  }

  void take(const Crew::Finished& finished) {
    const auto& [job, event] = finished;
    if (const auto* failure = std::get_if<FailureJob>(&job)) return failures_.take(*failure, event);
    const auto& [place, task] = std::get<PlacedCase>(job);
    if (event.end == WorkerEnd::replied) return round_.take_report(place, parse_report<EvaluateReport>(event.text));
    const Case ended = case_of_ending(event, spec_of(config_, generator_, task.lineage), config_.limits);
    round_.take_ending(place, ended, state_.record.families.contains(family_of(ended)));
  }

  // Processes the results in the order of cases. If time cut a round short, its cases count up to the first one that
  // did not run; a resumed run begins the round again.
  void fold_round() {
    if (!round_.is_whole()) {
      keep_state_now();
      is_cut_ = true;
      if (result_.interrupted) return;
    }
    for (const RoundCase& one : round_.cases()) {
      if (!one.report) return;
      fold(one);
    }
    state_.next += kRound;
    if (config_.cases >= 0) state_.next = std::min(state_.next, config_.cases);
  }

  void fold(const RoundCase& one) {
    tell(one);
    for (const SettleTask& task : statistics_.add(one)) failures_.want(task);
    if (one.ended_once) failures_.keep_ending_of_once(*one.ended_once, one.lineage);
  }

  void tell(const RoundCase& one) {
    const std::vector<Family> broken = counted_families(*one.report);
    if (!listeners_.failing || broken.empty()) return;
    listeners_.failing({one.lineage.back(), statistics_.strategy_of_case(one.lineage), broken,
                        spec_of(config_, generator_, one.lineage)});
  }

  void keep_state_sometimes() {
    const double now_s = steady_s();
    if (!pace_.is_due(now_s)) return;
    keep_state_now();
    pace_.kept(now_s, steady_s());
  }

  // After a round was cut short, the stored state remains the one from before this round.
  void keep_state_now() {
    if (!ok() || is_cut_) return;
    if (const Result<Done> kept = keep_state(corpus_, state_); !kept) fail(kept.issue());
  }

  // All workers have ended, and the run's lock keeps other processes away.
  void finish() {
    fail(failures_.issue());
    if (const Result<Done> dropped = drop_half_written(corpus_, state_.record); !dropped) fail(dropped.issue());
    tidy_leads(corpus_, state_.record.name);
    // A stopped shard writes no record: merge would take it for a complete one.
    if (ok() && !(result_.interrupted && config_.shard.count > 1))
      if (const Result<Done> kept = keep_run(corpus_, state_.record); !kept) fail(kept.issue());
    if (result_.interrupted || !ok())
      keep_state_now();
    else
      drop_state(corpus_, state_.record);
    report();
    tell_result();
  }

  void tell_result() {
    result_.record = state_.record;
    result_.elapsed_s = time_.elapsed_s(steady_s());
    result_.waiting = failures_.waiting();
    result_.unsettled = static_cast<int>(state_.wanted.size());
    result_.waivers = state_.waivers;
    for (const std::string& name : state_.new_buckets) result_.new_buckets.push_back(bucket_folder(name));
    for (const std::string& name : state_.known_buckets) result_.known_buckets.push_back(bucket_folder(name));
    result_.unconfirmed = state_.unconfirmed;
  }

  std::string bucket_folder(const std::string& name) const { return corpus_.folder() + "/buckets/" + name; }

  void fail(const Issue& issue) {
    if (result_.issue.code.empty()) result_.issue = issue;
  }

  void report() {
    const RunRecord& record = state_.record;
    listeners_.progress({record.cases + round_.done_count(), record.frames, record.failing,
                         static_cast<int>(record.families.size()), static_cast<int>(state_.new_buckets.size()),
                         failures_.waiting_count(), time_.elapsed_s(steady_s())});
  }

  RunConfig config_;
  Generator& generator_;
  const Corpus& corpus_;
  const Listeners listeners_;
  const Odds odds_ = odds_of(config_.seed, config_.draw.profile);
  const double start_s_ = steady_s();
  TimeBudget time_{config_.time_s, start_s_};
  KeepingPace pace_{start_s_};
  RunState state_;
  Round round_{config_.against.has_value()};
  bool is_cut_ = false;  // the last round was cut short
  FailureQueue failures_{config_, generator_, corpus_, state_};
  RunStatistics statistics_{config_, state_};
  RunResult result_;
};

}  // namespace

Provenance provenance_in(const RunConfig& config, std::int64_t index) {
  Provenance from;
  from.tool = config.tool, from.seed = config.seed, from.index = index;
  from.generator = config.generator, from.generator_build = config.generator_build;
  if (config.draw.profile != Profile{}) from.profile = config.draw.profile.name;
  return from;
}

Spec spec_of(const RunConfig& config, Generator& generator, const Lineage& lineage) {
  const std::int64_t index = lineage.back();
  if (is_seed(config, index)) return config.seeds[static_cast<std::size_t>(index)];
  return compose(raw_of(config.draw, generator, config.seed, lineage), config.draw, generator);
}

std::string run_name(const RunConfig& config) {
  std::string text = print_profile(config.draw.profile) + config.surroundings;
  for (const std::string& name : config.draw.characters) text += name + "\n";
  for (const Spec& spec : config.seeds) text += spec_id(spec) + "\n";
  if (config.against) text += "against " + config.against->base + " " + std::to_string(config.against->rules.tolerance);
  return "seed_" + std::to_string(config.seed) + "_" + content_id(text).substr(0, 8);
}

RunResult run_fuzz(const RunConfig& config, Generator& generator, const Corpus& corpus,
                   const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop,
                   const std::function<void(const FailingCase&)>& failing) {
  return Run(config, generator, corpus, {progress, stop, failing}).run();
}

}  // namespace contort
