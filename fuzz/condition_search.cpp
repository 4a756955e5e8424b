#include "fuzz/condition_search.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <iterator>
#include <mutex>

#include "fuzz/evaluators.h"
#include "fuzz/parallel.h"
#include "fuzz/population.h"
#include "fuzz/rule_learning.h"
#include "process/ended.h"

namespace contort {

namespace {

constexpr int kEnoughSamples = 30;              // least number of failing and of passing cases to learn from
constexpr int kMostRounds = 3;  // greatest number of rounds of drawing, until there are enough cases and a rule holds
constexpr double kAlwaysFrom = 0.95;         // fraction of failing draws above which the rule has no comparison
constexpr double kLeastPrecision = 0.8;  // least precision of a reported rule
constexpr int kLeastTried = 20;          // least number of fresh cases on each side on which a rule must be tried
constexpr std::int64_t kMostDraws = 20'000;
constexpr std::int64_t kFirstFresh = std::int64_t{1} << 32;  // index of the first fresh draw

// The draws that ended a program under test. Several threads add to it.
class Endings {
 public:
  void add(const Ending& ending) {
    const std::lock_guard lock(mutex_);
    late_ += ending.kind == Ending::Kind::timeout ? 1 : 0;
    if (count_++ == 0) first_ = describe(ending, kMostPrintedTold);
  }
  int count() const { return count_; }
  int late() const { return late_; }
  const std::string& first() const { return first_; }

 private:
  static constexpr std::size_t kMostPrintedTold = 200;
  std::mutex mutex_;
  std::atomic<int> count_{0}, late_{0};
  std::string first_;
};

class Search {
 public:
  Search(const Case& minimal, const Population& population, Generator& generator, const CheckSettings& settings,
         const ConditionSearch& options)
      : kind_(kind_of_check(minimal.expect.check)), population_(population), generator_(generator),
        evaluators_(generator, settings, options.jobs), options_(options) {}

  // Draws and judges further cases to learn from.
  void learn_more(std::vector<RuleSample>& samples) {
    std::vector<RuleSample> more = judged(drawn(options_.draws, next_to_learn_));
    std::ranges::move(more, std::back_inserter(samples));
  }

  // Draws until both sides of the rule have enough cases, and judges them.
  RuleTrial trial(const std::vector<Conjunction>& any_of) {
    std::array<std::vector<DrawnRequest>, 2> sides;
    std::array<int, 2> drawn_on{};
    const auto wanted = static_cast<std::size_t>(options_.fresh);
    const bool is_always = any_of.front().empty();
    const std::int64_t end = next_fresh_ + kMostDraws;
    while (next_fresh_ < end && (sides[1].size() < wanted || (!is_always && sides[0].size() < wanted))) {
      std::optional<DrawnRequest> one = population_.draw(generator_, next_fresh_++);
      if (!one) continue;
      const std::size_t side = rule_holds(any_of, one->request) ? 1 : 0;
      ++drawn_on[side];
      if (sides[side].size() < wanted) sides[side].push_back(std::move(*one));
    }
    RuleTrial trial;
    trial.inside_share = static_cast<double>(drawn_on[1]) / std::max(1, drawn_on[0] + drawn_on[1]);
    count(judged(std::move(sides[1])), trial.inside, trial.inside_failing);
    count(judged(std::move(sides[0])), trial.outside, trial.outside_failing);
    return trial;
  }

  // At least half of the draws must have finished; otherwise the sample says nothing about the rest.
  Result<Done> enough_ran() const {
    const int ended = endings_.count();
    if (endings_.late() < kMostLateDraws && 2 * ended <= judged_) return Done{};
    const bool is_late = endings_.late() >= kMostLateDraws;  // then not all draws were run
    const std::string share = std::to_string(ended) + (is_late ? "" : " of " + std::to_string(judged_));
    return Issue{"explain.program_ended", "",
                 "no condition can be learned, because the generator makes no motion of " + share +
                     " requests like the minimal case: " + endings_.first()};
  }

 private:
  std::vector<DrawnRequest> drawn(int count, std::int64_t& index) {
    std::vector<DrawnRequest> all;
    for (const std::int64_t end = index + kMostDraws; index < end && std::ssize(all) < count;)
      if (std::optional<DrawnRequest> one = population_.draw(generator_, index++)) all.push_back(std::move(*one));
    return all;
  }

  // A draw that ends the program under test, or is refused, is no sample. After too many late draws no further ones
  // run.
  std::vector<RuleSample> judged(std::vector<DrawnRequest> all) {
    std::vector<char> fails(all.size(), 0), ran(all.size(), 0);
    parallel_for(options_.jobs, static_cast<int>(all.size()), [&](int worker, int index) {
      const auto i = static_cast<std::size_t>(index);
      if (endings_.late() >= kMostLateDraws) return;
      try {
        const Result<Evaluation> run = evaluators_.of(worker).run(all[i].spec);
        ran[i] = run.ok();
        fails[i] = run && std::ranges::any_of(run->findings, [&](const Finding& finding) {
          return kind_of_check(finding.check) == kind_;
        });
      } catch (const ProgramEnded& ended) {
        endings_.add(ended.ending());
      }
    }, [] {});
    judged_ += static_cast<int>(all.size());
    std::vector<RuleSample> samples;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (ran[i]) samples.push_back({std::move(all[i].request), fails[i] != 0});
    return samples;
  }

  static void count(const std::vector<RuleSample>& samples, int& all, int& failing) {
    all = static_cast<int>(samples.size());
    failing = static_cast<int>(std::ranges::count_if(samples, &RuleSample::fails));
  }

  CheckKind kind_;
  Endings endings_;
  int judged_ = 0;  // number of draws that were judged
  const Population& population_;
  Generator& generator_;
  Evaluators evaluators_;
  const ConditionSearch& options_;
  std::int64_t next_to_learn_ = 0;  // index of the next draw to learn from
  std::int64_t next_fresh_ = kFirstFresh;
};

std::vector<Conjunction> learned(const std::vector<RuleSample>& samples, int failing) {
  if (!samples.empty() && failing >= kAlwaysFrom * static_cast<double>(samples.size())) return {{}};
  const std::optional<std::vector<Conjunction>> rule = learn_rule(samples);
  return rule ? *rule : std::vector<Conjunction>{};
}

// True if there are enough failing and passing cases, or if almost all cases fail.
bool has_enough(const Condition& condition) {
  const int passing = condition.drawn - condition.failing;
  return std::min(condition.failing, passing) >= kEnoughSamples || condition.failing >= kAlwaysFrom * condition.drawn;
}

bool is_told(const Condition& condition) {
  const RuleTrial& trial = condition.trial;
  if (trial.inside < kLeastTried || precision_of(trial) < kLeastPrecision) return false;
  if (condition.any_of.front().empty()) return true;
  return trial.outside >= kLeastTried && failing_outside(trial) <= 0.5 * precision_of(trial);
}

}  // namespace

bool can_have_condition(const Case& minimal) {
  const Cause cause = cause_of(minimal);
  const auto is_named = [&](const char* name) { return std::ranges::find(cause.names, name) != cause.names.end(); };
  const bool is_recorded = !minimal.spec.recording.name.empty();
  return !is_abnormal_exit(minimal.expect) && !is_recorded &&
         !(cause.scope == CauseScope::setting && is_named("swap"));
}

Result<Condition> find_condition(const Case& minimal, Generator& generator, const CheckSettings& settings,
                                 const ConditionSearch& options) {
  const Cause cause = cause_of(minimal);
  const Result<Population> population = Population::like(minimal, generator);
  if (!population) return population.issue();
  Condition found{.cause = cause_id_of(minimal),
                  .headline = cause_headline(minimal),
                  .character = minimal.spec.character.name,
                  .character_hash = minimal.expect.character_hash,
                  .tool = options.tool,
                  .learned_from = spec_id(minimal.spec),
                  .needs = needs_of(cause)};
  Search search(minimal, *population, generator, settings, options);
  std::vector<RuleSample> samples;
  for (int round = 0; round < kMostRounds && !has_rule(found); ++round) {
    search.learn_more(samples);
    if (const Result<Done> enough = search.enough_ran(); !enough) return enough.issue();
    found.drawn = static_cast<int>(samples.size());
    found.failing = static_cast<int>(std::ranges::count_if(samples, &RuleSample::fails));
    if (!has_enough(found) && round + 1 < kMostRounds) continue;
    found.any_of = learned(samples, found.failing);
    if (has_rule(found)) found.trial = search.trial(found.any_of);
    if (const Result<Done> enough = search.enough_ran(); !enough) return enough.issue();
    if (has_rule(found) && !is_told(found)) found.any_of.clear(), found.trial = {};
  }
  return found;
}

}  // namespace contort
