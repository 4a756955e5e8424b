#include "fuzz/run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <set>

#include "corpus/leads.h"
#include "corpus/replay.h"
#include "corpus/runs.h"
#include "fuzz/parallel.h"
#include "generator/core/hash.h"

namespace contort {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What one case gave.
struct Outcome {
  bool ran = false;
  bool built = false;
  Spec spec;
  int frames = 0;
  std::vector<std::string> uses;  // of actions
  std::set<std::string> pairs;    // of actions at the same time on one part
  std::vector<WaiverUse> waivers;
  std::vector<Case> failures;  // the deepest finding of each family, in order of first appearance
};

std::vector<Case> failures_of(const Spec& spec, const Stage& stage, const Motion& motion,
                              const Evaluation& evaluation) {
  std::vector<Case> failures;
  std::set<std::string> seen;
  for (const Finding& finding : evaluation.findings) {
    if (!seen.insert(family_of(spec.character.name, finding)).second) continue;
    const Finding& worst = *deepest(evaluation.findings, finding.check, finding.subject);
    failures.push_back({spec,
                        {worst.check,
                         worst.subject,
                         worst.unit,
                         worst.first_frame,
                         worst.worst_frame,
                         worst.last_frame,
                         worst.worst_margin,
                         std::isfinite(worst.depth) ? worst.depth : 0.0,
                         {},
                         {},
                         {}},
                        {}});
  }
  // Hash and trace are the motion's: the same for all of its failures, and computed only where there are any.
  if (failures.empty()) return failures;
  const Expectation whole = expectation_of(stage, motion, evaluation, evaluation.findings.front());
  for (Case& failure : failures) {
    failure.expect.motion_hash = whole.motion_hash;
    failure.expect.character_hash = whole.character_hash;
    failure.expect.trace = whole.trace;
  }
  return failures;
}

// "action reach (ik) on arm_left", once for each use.
std::vector<std::string> uses_of(const Stage& stage) {
  std::vector<std::string> uses;
  for (const PlannedAction& action : stage.timeline.actions)
    if (action.part == action.named)
      uses.push_back("action " + action.name + " (" + std::string(layer_name(action.def->layer)) + ") on " +
                     stage.character->parts()[static_cast<std::size_t>(action.part)].slot);
  return uses;
}

// "pair pose + reach on arm_left" for actions that move one part at the same time.
std::set<std::string> pairs_of(const Stage& stage) {
  std::set<std::string> pairs;
  const Timeline& timeline = stage.timeline;
  for (std::size_t i = 0; i < timeline.of_part.size(); ++i) {
    const Part& part = stage.character->parts()[i % stage.character->parts().size()];
    for (const int a : timeline.of_part[i])
      for (const int b : timeline.of_part[i]) {
        const PlannedAction& x = timeline.actions[static_cast<std::size_t>(a)];
        const PlannedAction& y = timeline.actions[static_cast<std::size_t>(b)];
        if (a == b || x.name > y.name || x.first_frame > y.last_frame || y.first_frame > x.last_frame) continue;
        pairs.insert("pair " + x.name + " + " + y.name + " on " + part.slot);
      }
  }
  return pairs;
}

// Another seed or other characters are another run: what both found is counted twice, not once.
std::string name_of(const RunConfig& config) {
  std::string characters;
  for (const std::string& name : config.draw.characters) characters += name + "\n";
  return "seed_" + std::to_string(config.seed) + "_" + content_id(characters).substr(0, 8);
}

class Run {
 public:
  Run(const RunConfig& config, const Library& library, const Corpus& corpus,
      const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop)
      : config_(config), library_(library), corpus_(corpus), progress_(progress), stop_(stop) {
    for (int i = 0; i < config.jobs; ++i) evaluators_.emplace_back(config.checks);
    run_name_ = name_of(config);
  }

  RunResult run() {
    for (std::int64_t first = 0; !finished(first) && ok(); first += config_.batch) {
      std::int64_t count = config_.batch;
      if (config_.cases >= 0) count = std::min(count, config_.cases - first);
      run_batch(first, static_cast<int>(count));
    }
    record_run();
    report();
    return std::move(result_);
  }

 private:
  bool ok() const { return result_.issue.code.empty(); }
  bool out_of_time() const { return config_.time_s > 0.0 && seconds_since(start_) >= config_.time_s; }
  bool finished(std::int64_t first) {
    if (stop_()) result_.interrupted = true;
    return result_.interrupted || out_of_time() || (config_.cases >= 0 && first >= config_.cases);
  }
  bool halted() { return stop_() || out_of_time(); }

  void run_batch(std::int64_t first, int count) {
    std::vector<Outcome> outcomes(static_cast<std::size_t>(count));
    parallel_for(
        config_.jobs, count,
        [&](int worker, int i) {
          if (!halted())
            outcomes[static_cast<std::size_t>(i)] = run_case(evaluators_[static_cast<std::size_t>(worker)], first + i);
        },
        [&] { report(); });
    std::vector<Case> candidates;
    for (Outcome& outcome : outcomes) {
      if (!outcome.ran) break;  // time is up; what ran out of order behind the gap does not count
      fold(outcome, candidates);
    }
    settle(candidates);
    report();
  }

  Outcome run_case(Evaluator& evaluator, std::int64_t index) const {
    Outcome outcome;
    outcome.ran = true;
    outcome.spec = draw_spec(config_.draw, library_, config_.seed, index);
    const Result<Stage> stage = build_stage(outcome.spec, library_);
    if (!stage) return outcome;
    outcome.built = true;
    outcome.uses = uses_of(*stage);
    outcome.pairs = pairs_of(*stage);
    const Evaluation evaluation = evaluator.run(*stage);
    outcome.frames = evaluation.frame_count;
    outcome.waivers = evaluation.waivers;
    outcome.failures = failures_of(outcome.spec, *stage, evaluator.motion(), evaluation);
    for (Case& failure : outcome.failures) failure.provenance = {config_.tool, config_.seed, index, "", 0, ""};
    return outcome;
  }

  void fold(Outcome& outcome, std::vector<Case>& candidates) {
    RunProgress& totals = result_.totals;
    ++totals.cases;
    totals.frames += outcome.frames;
    if (!outcome.built) ++result_.discarded;
    if (!outcome.failures.empty()) ++totals.failing;
    count_tested(outcome.spec);
    add_uses(outcome.waivers, result_.waivers);
    for (const std::string& use : outcome.uses) ++result_.tested[use];
    for (const std::string& pair : outcome.pairs) ++result_.tested[pair];
    for (Case& failure : outcome.failures) {
      const std::string family = family_of(failure);
      FamilyCount& count = record_.families.try_emplace(family, FamilyCount{0, failure.provenance.index}).first->second;
      const std::int64_t seen = result_.families[family] = ++count.cases;
      if (seen <= config_.shrinks_per_family) candidates.push_back(std::move(failure));
    }
    totals.families = static_cast<int>(result_.families.size());
  }

  void count_tested(const Spec& spec) {
    ++result_.tested["character " + spec.character.name];
    for (const auto& [slot, part] : spec.character.parts) ++result_.tested["part " + part];
    for (const AttachmentDesc& attachment : spec.character.attachments) ++result_.tested["object " + attachment.object];
    static constexpr const char* kGrounds[] = {"plane", "slope", "steps", "heights"};
    ++result_.tested[std::string("ground ") + kGrounds[spec.environment.ground.index()]];
    if (!spec.environment.obstacles.empty()) ++result_.tested["obstacle"];
    for (const InterruptDesc& interrupt : spec.interrupts)
      ++result_.tested["interrupt on " + std::string(event_name(interrupt.when.event))];
  }

  // Written to disk first, then confirmed from there, then shrunk, then stored: a kill at any point loses nothing.
  void settle(const std::vector<Case>& candidates) {
    std::vector<std::string> leads;
    for (const Case& candidate : candidates) {
      const Result<std::string> lead = keep_lead(corpus_, {run_name_, candidate, {}});
      if (!lead) return fail(lead.issue());
      leads.push_back(*lead);
    }
    std::vector<Case> minimal(candidates.size());
    std::vector<char> confirmed(candidates.size(), 0);
    shrinking_ = static_cast<int>(candidates.size());
    parallel_for(
        config_.jobs, static_cast<int>(candidates.size()),
        [&](int worker, int i) {
          const auto c = static_cast<std::size_t>(i);
          confirmed[c] = confirm(leads[c], evaluators_[static_cast<std::size_t>(worker)]);
          if (confirmed[c]) minimal[c] = shrink_one(candidates[c]);
          --shrinking_;
        },
        [&] { report(); });
    for (std::size_t c = 0; c < candidates.size() && ok(); ++c) {
      if (confirmed[c])
        store(minimal[c], candidates[c]);
      else
        result_.unconfirmed.push_back(leads[c]);
    }
  }

  bool confirm(const std::string& lead, Evaluator& evaluator) const {
    const Result<Case> stored = read_case(lead);
    return stored && replay(*stored, library_, evaluator).verdict == Verdict::same;
  }

  Case shrink_one(const Case& candidate) {
    ShrinkConfig config = config_.shrink;
    config.checks = config_.checks;
    config.out_of_time = [this] { return halted(); };
    return shrink(candidate, library_, config).minimal;
  }

  void store(const Case& minimal, const Case& original) {
    const Result<Corpus::Added> added = corpus_.add({minimal, original, run_name_});
    if (!added) return fail(added.issue());
    drop_lead(corpus_, {run_name_, original, {}});
    std::vector<std::string>& list = added->is_new ? result_.new_buckets : result_.known_buckets;
    const auto known = [&](const std::vector<std::string>& l) {
      return std::find(l.begin(), l.end(), added->bucket) != l.end();
    };
    if (!known(result_.new_buckets) && !known(result_.known_buckets)) list.push_back(added->bucket);
    result_.totals.buckets_new = static_cast<int>(result_.new_buckets.size());
  }

  void record_run() {
    const RunProgress& totals = result_.totals;
    record_.name = run_name_, record_.tool = config_.tool;
    record_.cases = totals.cases, record_.frames = totals.frames, record_.failing = totals.failing;
    record_.discarded = result_.discarded, record_.tested = result_.tested;
    if (!ok()) return;
    if (const Result<Done> kept = keep_run(corpus_, record_); !kept) fail(kept.issue());
  }

  void fail(const Issue& issue) {
    if (ok()) result_.issue = issue;
  }

  void report() {
    result_.totals.elapsed_s = seconds_since(start_);
    result_.totals.shrinking = shrinking_;
    progress_(result_.totals);
  }

  const RunConfig& config_;
  const Library& library_;
  const Corpus& corpus_;
  const std::function<void(const RunProgress&)>& progress_;
  const std::function<bool()>& stop_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<Evaluator> evaluators_;
  std::string run_name_;
  RunRecord record_;
  std::atomic<int> shrinking_{0};
  RunResult result_;
};

}  // namespace

RunResult run_fuzz(const RunConfig& config, const Library& library, const Corpus& corpus,
                   const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop) {
  return Run(config, library, corpus, progress, stop).run();
}

}  // namespace contort
