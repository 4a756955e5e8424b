#include "fuzz/run.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <filesystem>

#include "corpus/half_written.h"
#include "corpus/leads.h"
#include "fuzz/case_work.h"
#include "fuzz/compose.h"
#include "fuzz/run_state.h"
#include "generator/core/hash.h"

namespace contort {

namespace {

double steady_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string plan_of(const RunConfig& config) {
  return run_name(config) + " shrinks=" + std::to_string(config.shrinks_per_family) +
         " of_case=" + std::to_string(config.shrinks_per_case) +
         " evaluations=" + std::to_string(config.shrink.max_evaluations) +
         " shrink_time=" + std::to_string(config.shrink_time_s);
}

// "crash|human|SIGSEGV": what became of the process that ran a spec.
Case case_of_ending(const WorkerEvent& event, const WorkerLimits& limits) {
  const Result<Spec> noted = parse_spec(event.note);
  Spec spec;
  spec.character.name = "unknown";
  if (noted) spec = *noted;
  return ending_case(spec, ending_of(event), isolation_of(limits));
}

class Run {
 public:
  Run(const RunConfig& config, const Library& library, const Corpus& corpus,
      const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop,
      const std::function<void(const FailingCase&)>& failing)
      : config_(config), library_(library), corpus_(corpus), progress_(progress), stop_(stop), failing_(failing) {
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
    if (config_.shard.count == 1) find_waiting();
    if (ok()) search();
    finish();
    return std::move(result_);
  }

 private:
  bool ok() const { return result_.issue.code.empty(); }
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
    for (const CaseTask& task : state_.wanted) settling_.push_back(task);
  }

  // What runs before left in this corpus, since their time was up before it was shrunk.
  void find_waiting() {
    std::vector<Issue> damaged;
    for (const Lead& lead : leads_of(corpus_, damaged)) {
      if (!waits(lead)) continue;
      CaseTask task;
      task.lineage = {lead.original.provenance.index};
      task.family = family_of(lead.original);
      task.lead = lead_path(corpus_, lead);
      waiting_.push_back(task);
    }
  }

  void search() {
    WorkerPool pool(config_.jobs, config_.limits, CaseWork(config_, library_, corpus_));
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
    while (ok() && !result_.interrupted && (pool.busy() > 0 || !settling_.empty() || has_time_for_waiting())) {
      if (stop_()) result_.interrupted = true;
      if (out_of_time())
        for (CaseTask& task : settling_) task.shrinks = false;
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
    return halted() || (config_.deadline_s > 0.0 && steady_s() >= fold_at_s_ && std::ranges::any_of(round_, has_failed));
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
    if (const auto next = next_to_settle(); next != settling_.end()) {
      const Running running{-1, *next};
      settling_.erase(next);
      return running;
    }
    if (has_time_for_waiting()) {
      const Running running{-1, waiting_.front()};
      waiting_.pop_front();
      return running;
    }
    if (!again_.empty()) {
      const int place = again_.back();
      again_.pop_back();
      return Running{place, {}};
    }
    if (given_ < static_cast<int>(round_.size())) return Running{given_++, {}};
    return std::nullopt;
  }

  // Half of the run's time at most is for what earlier ones left.
  bool has_time_for_waiting() const {
    return !waiting_.empty() && !(config_.time_s > 0.0 && steady_s() >= start_s_ + 0.5 * config_.time_s);
  }

  // Of one case one failure at a time: what a minimal spec shows too is not settled any more.
  std::deque<CaseTask>::iterator next_to_settle() {
    return std::ranges::find_if(settling_, [&](const CaseTask& task) {
      return std::ranges::none_of(running_,
                                  [&](const Running& r) { return r.settled && r.settled->lineage == task.lineage; });
    });
  }

  void take(const WorkerEvent& event) {
    const Running running = std::exchange(running_[static_cast<std::size_t>(event.worker)], {});
    if (running.settled && !running.settled->lead.empty()) return shrunk_waiting(*running.settled, event);
    if (running.settled) return settled(*running.settled, event);
    Place& place = round_[static_cast<std::size_t>(running.place)];
    if (event.end == WorkerEnd::replied)
      place.report = parse_report(event.text);
    else
      take_ending(place, running.place, case_of_ending(event, config_.limits));
    open_ -= place.report.has_value();
  }

  // What ended its process is tried again, as it may have been ended from outside: by people, or for want of memory. What
  // was met in an earlier round needs no second witness.
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
      if (place.ended) keep_ending_of_once(*place.ended, place.task);
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
      failing_({index, arm_name, report.broken, spec_of(config_, library_, task.lineage)});
    state_.islands[static_cast<std::size_t>(island_of(index))].learn(task.lineage, report.near, report.broken);
    for (std::size_t rank = 0; rank < report.broken.size(); ++rank) {
      const std::string& family = report.broken[rank];
      FamilyCount& count = record.families.try_emplace(family, FamilyCount{0, index, {}, arm_name}).first->second;
      ++count.cases;
      if (std::cmp_greater_equal(rank, config_.shrinks_per_case)) continue;
      if (std::ssize(count.first_indices) >= config_.shrinks_per_family) continue;
      count.first_indices.push_back(index);
      want({task.lineage, family, static_cast<int>(rank), report.motion_hash, task.ending, true, {}});
    }
  }

  // ---- failures

  // A failure that was seen once and did not come again. Whoever looks for it begins with its spec.
  void keep_unsteady(const Case& seen, const CaseTask& task) {
    Lead lead{state_.record.name, seen, {}};
    lead.original.provenance = provenance_in(config_, task.lineage.back());
    lead.original.provenance.rank = task.rank;
    lead.original.provenance.shrink_stopped = kUnsteady;
    if (const Result<std::string> kept = keep_lead(corpus_, lead); !kept) fail(kept.issue());
  }

  void want(const CaseTask& task) {
    state_.wanted.push_back(task);
    settling_.push_back(task);
  }

  void settled(const CaseTask& task, const WorkerEvent& event) {
    const CaseReport report = event.end == WorkerEnd::replied ? parse_report(event.text) : CaseReport{};
    if (event.end != WorkerEnd::replied && task.ending.empty()) return shrink_guarded(task, event);
    if (event.end != WorkerEnd::replied)
      keep_unsteady(seen_once(task, spec_of(config_, library_, task.lineage), library_, config_.limits), task);
    settle_no_more(task, {task.family});
    if (report.confirmed && config_.shard.count == 1) settle_no_more(task, report.also);
    if (!report.issue.empty()) return fail({"file.unwritable", "", report.issue});
    if (report.confirmed && !task.shrinks) return result_.waiting.push_back(path_of_lead(task));
    take_lead(path_of_lead(task), report.confirmed);
    take_met(state_.record.name, task, report);
    if (task.ending.empty() || task.ending == task.family) return;
    if (std::ranges::find(report.met, task.ending) == report.met.end())
      take_lead(path_of_met(state_.record.name, task, task.ending), false);
  }

  void take_met(const std::string& run, const CaseTask& task, const CaseReport& report) {
    for (const std::string& family : report.met) take_lead(path_of_met(run, task, family), true);
    for (const std::string& family : report.met_once) take_lead(path_of_met(run, task, family), false);
  }

  // It may have been another process that did it, or this one under another name before. What ended its worker waits for
  // a run with a guard: it is tried once more, like any other.
  void shrunk_waiting(CaseTask task, const WorkerEvent& event) {
    if (event.end != WorkerEnd::replied && task.ending.empty()) {
      task.ending = family_of(case_of_ending(event, config_.limits));
      return waiting_.push_front(task);
    }
    const CaseReport report = event.end == WorkerEnd::replied ? parse_report(event.text) : CaseReport{};
    if (!report.issue.empty()) return fail({"file.unwritable", "", report.issue});
    if (std::error_code error; !std::filesystem::exists(task.lead, error)) return;
    const std::string run = std::filesystem::path(task.lead).parent_path().filename();
    take_lead(task.lead, report.confirmed);
    take_met(run, task, report);
    tidy_leads(corpus_, run);
  }

  // Which families of the case need no bucket of their own, a shard leaves to `merge`: it shrinks more than a whole
  // run.
  void settle_no_more(const CaseTask& of_case, const std::vector<std::string>& families) {
    const auto is_done = [&](const CaseTask& task) {
      return task.lineage == of_case.lineage && std::ranges::find(families, task.family) != families.end();
    };
    std::erase_if(state_.wanted, is_done);
    std::erase_if(settling_, is_done);
  }

  // A candidate of its shrinking ended the process: a failure of its own, kept at once. The guarded worker meets it
  // again, or else it is not confirmed. It still comes before the later failures of its case.
  void shrink_guarded(CaseTask task, const WorkerEvent& event) {
    Lead lead{state_.record.name, case_of_ending(event, config_.limits), {}};
    lead.original.provenance = provenance_in(config_, task.lineage.back());
    lead.original.provenance.met_shrinking = task.family;
    if (const Result<std::string> kept = keep_lead(corpus_, lead); !kept) return fail(kept.issue());
    task.ending = family_of(lead.original);
    settling_.push_front(std::move(task));
  }

  // It ended its process and, tried again, did not. The note of the first time may not have been written yet.
  void keep_ending_of_once(Case ended, const CaseTask& task) {
    ended.spec = spec_of(config_, library_, task.lineage);
    keep_unsteady(ended, task);
    add_once(state_.unconfirmed, lead_path(corpus_, state_.record.name, family_of(ended), task.lineage.back()));
  }

  void take_lead(const std::string& path, bool confirmed) {
    if (confirmed && config_.shard.count == 1) file(path);
    if (confirmed) return;
    add_once(state_.unconfirmed, path);
    Result<Lead> read = read_lead(path);
    if (!read || is_unsteady(*read)) return;
    Lead lead = std::move(read).value();
    lead.original.provenance.shrink_stopped = kUnsteady;
    if (const Result<std::string> kept = keep_lead(corpus_, lead); !kept) fail(kept.issue());
  }

  void file(const std::string& path) {
    const Result<Lead> lead = read_lead(path);
    if (!lead) return fail(lead.issue());
    const Result<Corpus::Added> added = file_lead(corpus_, *lead);
    if (!added) return fail(added.issue());
    const std::string name = std::filesystem::path(added->bucket).filename();
    if (std::ranges::find(state_.new_buckets, name) != state_.new_buckets.end()) return;
    add_once(added->is_new ? state_.new_buckets : state_.known_buckets, name);
  }

  std::string path_of_lead(const CaseTask& task) const {
    return lead_path(corpus_, state_.record.name, task.family, task.lineage.back());
  }

  std::string path_of_met(const std::string& run, const CaseTask& task, const std::string& family) const {
    return lead_path(corpus_, run, family, task.lineage.back(), task.family);
  }

  static void add_once(std::vector<std::string>& list, const std::string& name) {
    if (const auto at = std::ranges::lower_bound(list, name); at == list.end() || *at != name) list.insert(at, name);
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
    for (const CaseTask& task : waiting_) result_.waiting.push_back(task.lead);
    result_.unsettled = static_cast<int>(state_.wanted.size());
    result_.waivers = state_.waivers;
    for (const std::string& name : state_.new_buckets) result_.new_buckets.push_back(bucket_folder(name));
    for (const std::string& name : state_.known_buckets) result_.known_buckets.push_back(bucket_folder(name));
    result_.unconfirmed = state_.unconfirmed;
  }

  std::string bucket_folder(const std::string& name) const { return corpus_.folder() + "/buckets/" + name; }

  void fail(const Issue& issue) {
    if (ok()) result_.issue = issue;
  }

  void report() {
    const RunRecord& record = state_.record;
    const auto of_round = static_cast<std::int64_t>(round_.size()) - open_;
    progress_({record.cases + of_round, record.frames, record.failing, static_cast<int>(record.families.size()),
               static_cast<int>(state_.new_buckets.size()), static_cast<int>(state_.wanted.size() + waiting_.size()),
               steady_s() - start_s_});
  }

  static constexpr double kKeepEvery_s = 1.0;
  static constexpr double kSettlingPatience = 4.0;  // what hangs is run to its limit in a process of its own

  RunConfig config_;
  const Library& library_;
  const Corpus& corpus_;
  const std::function<void(const RunProgress&)>& progress_;
  const std::function<bool()>& stop_;
  const std::function<void(const FailingCase&)>& failing_;
  const Odds odds_ = odds_of(config_.seed, config_.draw.profile);
  const double start_s_ = steady_s();
  double next_keep_s_ = steady_s() + kKeepEvery_s;
  RunState state_;
  std::vector<Place> round_;
  int open_ = 0;         // cases of the round without a report
  int given_ = 0;        // that were handed out
  bool is_cut_ = false;  // the last round was not done whole; what is kept is from before it
  std::vector<int> again_;  // places whose process ended, to be tried once more
  double fold_at_s_ = 0.0;
  std::deque<CaseTask> settling_;
  std::deque<CaseTask> waiting_;  // leads of runs whose time was up
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

Spec spec_of(const RunConfig& config, const Library& library, const Lineage& lineage) {
  const std::int64_t index = lineage.back();
  if (is_seed(config, index)) return config.seeds[static_cast<std::size_t>(index)];
  return compose(raw_of(config.draw, library, config.seed, lineage), config.draw, library);
}

std::string run_name(const RunConfig& config) {
  std::string text = print_profile(config.draw.profile) + config.settings;
  for (const std::string& name : config.draw.characters) text += name + "\n";
  for (const Spec& spec : config.seeds) text += spec_id(spec) + "\n";
  return "seed_" + std::to_string(config.seed) + "_" + content_id(text).substr(0, 8);
}

RunResult run_fuzz(const RunConfig& config, const Library& library, const Corpus& corpus,
                   const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop,
                   const std::function<void(const FailingCase&)>& failing) {
  return Run(config, library, corpus, progress, stop, failing).run();
}

}  // namespace contort
