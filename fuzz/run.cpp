#include "fuzz/run.h"

#include <algorithm>

#include "process/clock.h"
#include "corpus/half_written.h"
#include "corpus/leads.h"
#include "fuzz/case_work.h"
#include "fuzz/compose.h"
#include "fuzz/run_state.h"
#include "fuzz/settling.h"
#include "model/core/hash.h"

namespace contort {

namespace {

std::string plan_of(const RunConfig& config) {
  return run_name(config) + " shrinks=" + std::to_string(config.shrinks_per_family) +
         " of_case=" + std::to_string(config.shrinks_per_case) +
         " evaluations=" + std::to_string(config.shrink.max_evaluations) +
         " shrink_time=" + std::to_string(config.shrink_time_s);
}

class Run {
 public:
  Run(const RunConfig& config, Generator& generator, const Corpus& corpus,
      const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop,
      const std::function<void(const FailingCase&)>& failing)
      : config_(config), generator_(generator), corpus_(corpus), progress_(progress), stop_(stop), failing_(failing) {
    if (config_.time_s > 0.0) config_.deadline_s = start_s_ + config_.time_s;
    state_.plan = plan_of(config_);
    state_.record.name = run_name(config_);
    state_.record.tool = config_.tool;
    state_.record.shrinks_per_family = config_.shrinks_per_family;
    state_.record.shard = config_.shard.index, state_.record.shards = config_.shard.count;
  }

  RunResult run() {
    const Result<RunLock> lock = RunLock::take(corpus_, state_.record);
    if (!lock) return result_.issue = lock.issue(), std::move(result_);
    if (config_.resume) resume();
    if (config_.shard.count == 1) settling_.find_waiting();
    if (ok()) search();
    finish();
    return std::move(result_);
  }

 private:
  bool ok() const { return result_.issue.code.empty() && settling_.issue().code.empty(); }
  bool out_of_time() const { return config_.deadline_s > 0.0 && steady_s() >= config_.deadline_s; }
  bool is_last(std::int64_t index) const { return config_.cases >= 0 && index >= config_.cases; }
  bool halted() {
    if (stop_()) result_.interrupted = true;
    return result_.interrupted || out_of_time() || !ok();
  }

  void resume() {
    Result<std::optional<RunState>> kept = load_state(corpus_, state_.record, state_.plan);
    if (!kept) return fail(kept.issue());
    if (kept->has_value()) state_ = std::move(**kept);
    settling_.go_on();
  }

  void search() {
    WorkerPool pool(config_.jobs, config_.limits, CaseWork(config_, generator_, corpus_));
    running_.resize(static_cast<std::size_t>(config_.jobs));
    while (!is_last(state_.next) && !halted() && !is_cut_) {
      begin_round();
      while (open_ > 0 && !(must_fold() && !is_any_case_running())) step(pool, !must_fold());
      fold_round();
      round_.clear(), again_.clear(), open_ = 0, given_ = 0;
      keep_state_sometimes();
    }
    settle_the_rest(pool);
  }

  // Cases are over. Once time is up, what is left is only kept: another run on this corpus shrinks it.
  void settle_the_rest(WorkerPool& pool) {
    while (ok() && !result_.interrupted && (pool.busy() > 0 || !settling_.is_done(has_time_for_waiting()))) {
      if (stop_()) result_.interrupted = true;
      if (out_of_time()) settling_.only_keep();
      step(pool, true);
    }
  }

  // ---- a round

  struct Place {
    CaseTask task;
    std::optional<CaseReport> report;
    std::optional<Case> ended{};  // it ended its process the first time
  };

  void begin_round() {
    for (std::int64_t index = state_.next; index < state_.next + kRound && !is_last(index); ++index) {
      const int island = island_of(index);
      if (!is_of(config_.shard, island)) continue;
      const Island& pools = state_.islands[static_cast<std::size_t>(island)];
      const Lineage lineage = is_seed(config_, index) ? Lineage{index} : pools.lineage_of(odds_, index);
      round_.emplace_back();
      round_.back().task.lineage = lineage;
    }
    open_ = static_cast<int>(round_.size());
    if (config_.deadline_s > 0.0) fold_at_s_ = 0.5 * (steady_s() + config_.deadline_s);
  }

  // Half of the time that is left when the last round begins is for what it finds.
  bool must_fold() {
    const auto has_failed = [](const Place& place) { return place.report && !place.report->broken.empty(); };
    return halted() ||
           (config_.deadline_s > 0.0 && steady_s() >= fold_at_s_ && std::ranges::any_of(round_, has_failed));
  }

  bool is_any_case_running() const {
    return std::ranges::any_of(running_, [](const Running& r) { return r.place >= 0; });
  }

  // What a worker has in hand: a case of the round, or a failure to settle.
  struct Running {
    int place = -1;
    std::optional<CaseTask> settled;
  };

  void step(WorkerPool& pool, bool hand_out) {
    while (hand_out) {
      const std::optional<int> idle = pool.idle_worker();
      if (!idle) break;
      const std::optional<Running> next = take_next();
      if (!next) break;
      running_[static_cast<std::size_t>(*idle)] = *next;
      if (next->settled)
        pool.give(*idle, print_task(*next->settled), kSettlingPatience);
      else
        pool.give(*idle, print_task(round_[static_cast<std::size_t>(next->place)].task));
    }
    if (const std::optional<WorkerEvent> event = pool.wait(100)) take(*event);
    report();
  }

  // Failures go first: what was found shall be on its way to the user.
  std::optional<Running> take_next() {
    if (std::optional<CaseTask> task = settling_.next(has_time_for_waiting())) return Running{-1, std::move(task)};
    if (!again_.empty()) {
      const int place = again_.back();
      again_.pop_back();
      return Running{place, {}};
    }
    if (given_ < static_cast<int>(round_.size())) return Running{given_++, {}};
    return std::nullopt;
  }

  // Half of the run's time at most is for what earlier ones left.
  bool has_time_for_waiting() const { return !(config_.time_s > 0.0 && steady_s() >= start_s_ + 0.5 * config_.time_s); }

  void take(const WorkerEvent& event) {
    const Running running = std::exchange(running_[static_cast<std::size_t>(event.worker)], {});
    if (running.settled) return settling_.take(*running.settled, event);
    Place& place = round_[static_cast<std::size_t>(running.place)];
    if (event.end == WorkerEnd::replied)
      place.report = parse_report(event.text);
    else
      take_ending(place, running.place,
                  case_of_ending(event, spec_of(config_, generator_, place.task.lineage), config_.limits));
    open_ -= place.report.has_value();
  }

  // What ended its process is tried again, as it may have been ended from outside: by people, or for want of memory.
  // What was met in an earlier round needs no second witness.
  void take_ending(Place& place, int number, const Case& ended) {
    const std::string family = family_of(ended);
    if (!place.ended && !state_.record.families.contains(family)) {
      place.ended = ended;
      return again_.push_back(number);
    }
    place.ended.reset();
    place.report = CaseReport{};
    place.report->built = true;
    place.task.ending = family;
    place.report->broken = {family};
  }

  // In the order of cases. A round that time cut short counts up to the first case that did not run, but whoever
  // resumes begins it again.
  void fold_round() {
    const bool is_whole = open_ == 0;
    if (!is_whole) {
      keep_state_now();
      is_cut_ = true;
      if (result_.interrupted) return;
    }
    for (const Place& place : round_) {
      if (!place.report) return;
      fold(place.task, *place.report);
      if (place.ended) settling_.keep_ending_of_once(*place.ended, place.task);
    }
    state_.next += kRound;
    if (config_.cases >= 0) state_.next = std::min(state_.next, config_.cases);
  }

  void fold(const CaseTask& task, const CaseReport& report) {
    RunRecord& record = state_.record;
    const std::int64_t index = task.lineage.back();
    const std::string arm_name(is_seed(config_, index) ? "seed" : contort::arm_name(arm_of(odds_, task.lineage)));
    ArmCount& arm = record.arms[arm_name];
    ++record.cases, ++arm.cases;
    record.frames += report.frames;
    record.discarded += !report.built;
    record.failing += !report.broken.empty(), arm.failing += !report.broken.empty();
    for (const std::string& label : report.tested) ++record.tested[label];
    add_uses(report.waivers, state_.waivers);
    if (failing_ && !report.broken.empty())
      failing_({index, arm_name, report.broken, spec_of(config_, generator_, task.lineage)});
    state_.islands[static_cast<std::size_t>(island_of(index))].learn(task.lineage, report.near, report.broken);
    for (std::size_t rank = 0; rank < report.broken.size(); ++rank) {
      const std::string& family = report.broken[rank];
      FamilyCount& count = record.families.try_emplace(family, FamilyCount{0, index, {}, arm_name}).first->second;
      ++count.cases;
      if (std::cmp_greater_equal(rank, config_.shrinks_per_case)) continue;
      if (std::ssize(count.first_indices) >= config_.shrinks_per_family) continue;
      count.first_indices.push_back(index);
      settling_.want({task.lineage, family, static_cast<int>(rank), report.motion_hash, task.ending, true, {}});
    }
  }

  // ---- the end, and what is kept until then

  // As often as it costs at most 2 % of the time.
  void keep_state_sometimes() {
    const double now = steady_s();
    if (now < next_keep_s_) return;
    keep_state_now();
    next_keep_s_ = steady_s() + std::max(kKeepEvery_s, 50.0 * (steady_s() - now));
  }

  void keep_state_now() {
    if (!ok() || is_cut_) return;
    if (const Result<Done> kept = keep_state(corpus_, state_); !kept) fail(kept.issue());
  }

  // The workers are gone, and under the run's lock there are no others.
  void finish() {
    fail(settling_.issue());
    if (const Result<Done> dropped = drop_half_written(corpus_, state_.record); !dropped) fail(dropped.issue());
    tidy_leads(corpus_, state_.record.name);
    // Of a shard that was stopped there is no record: merging it would take what it did so far for all that it has to
    // say.
    if (ok() && !(result_.interrupted && config_.shard.count > 1))
      if (const Result<Done> kept = keep_run(corpus_, state_.record); !kept) fail(kept.issue());
    if (result_.interrupted || !ok())
      keep_state_now();
    else
      drop_state(corpus_, state_.record);
    report();
    result_.record = state_.record;
    result_.elapsed_s = steady_s() - start_s_;
    result_.waiting = settling_.waiting();
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
    const auto of_round = static_cast<std::int64_t>(round_.size()) - open_;
    progress_({record.cases + of_round, record.frames, record.failing, static_cast<int>(record.families.size()),
               static_cast<int>(state_.new_buckets.size()), settling_.waiting_count(), steady_s() - start_s_});
  }

  static constexpr double kKeepEvery_s = 1.0;
  static constexpr double kSettlingPatience = 4.0;  // what hangs is run to its limit in a process of its own

  RunConfig config_;
  Generator& generator_;
  const Corpus& corpus_;
  const std::function<void(const RunProgress&)>& progress_;
  const std::function<bool()>& stop_;
  const std::function<void(const FailingCase&)>& failing_;
  const Odds odds_ = odds_of(config_.seed, config_.draw.profile);
  const double start_s_ = steady_s();
  double next_keep_s_ = steady_s() + kKeepEvery_s;
  RunState state_;
  std::vector<Place> round_;
  int open_ = 0;            // cases of the round without a report
  int given_ = 0;           // that were handed out
  bool is_cut_ = false;     // the last round was not done whole; what is kept is from before it
  std::vector<int> again_;  // places whose process ended, to be tried once more
  double fold_at_s_ = 0.0;
  Settling settling_{config_, generator_, corpus_, state_};
  std::vector<Running> running_;  // by worker
  RunResult result_;
};

}  // namespace

Provenance provenance_in(const RunConfig& config, std::int64_t index) {
  Provenance from;
  from.tool = config.tool, from.seed = config.seed, from.index = index;
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
  return "seed_" + std::to_string(config.seed) + "_" + content_id(text).substr(0, 8);
}

RunResult run_fuzz(const RunConfig& config, Generator& generator, const Corpus& corpus,
                   const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop,
                   const std::function<void(const FailingCase&)>& failing) {
  return Run(config, generator, corpus, progress, stop, failing).run();
}

}  // namespace contort
