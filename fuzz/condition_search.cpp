#include "fuzz/condition_search.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "fuzz/evaluators.h"
#include "fuzz/parallel.h"
#include "fuzz/population.h"
#include "fuzz/rule_learning.h"

namespace contort {

namespace {

constexpr int kEnoughSamples = 30;              // failing and passing cases to learn from
constexpr int kMostRounds = 3;           // of drawing, until there are enough and a rule holds
constexpr double kAlwaysFrom = 0.95;         // share of failing draws from which on the rule has no comparison
constexpr double kLeastPrecision = 0.8;  // of a rule that is told
constexpr int kLeastTried = 20;          // fresh cases on each side, that a rule must have been tried on
constexpr std::int64_t kMostDraws = 20'000;
constexpr std::int64_t kFirstFresh = std::int64_t{1} << 32;  // index of the first fresh draw

class Search {
 public:
  Search(const Case& minimal, const Population& population, Generator& generator, const CheckSettings& settings,
         const ConditionSearch& options)
      : kind_(kind_of_check(minimal.expect.check)), population_(population), generator_(generator),
        evaluators_(generator, settings, options.jobs), options_(options) {}

  // Draws and judges so many further cases to learn from.
  void learn_more(std::vector<RuleSample>& samples) {
    std::vector<RuleSample> more = judged(drawn(options_.draws, next_to_learn_));
    std::ranges::move(more, std::back_inserter(samples));
  }

  // Draws until both sides of the rule have enough, and judges them.
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

 private:
  std::vector<DrawnRequest> drawn(int count, std::int64_t& index) {
    std::vector<DrawnRequest> all;
    for (const std::int64_t end = index + kMostDraws; index < end && std::ssize(all) < count;)
      if (std::optional<DrawnRequest> one = population_.draw(generator_, index++)) all.push_back(std::move(*one));
    return all;
  }

  std::vector<RuleSample> judged(std::vector<DrawnRequest> all) {
    std::vector<char> fails(all.size(), 0), ran(all.size(), 0);
    parallel_for(options_.jobs, static_cast<int>(all.size()), [&](int worker, int index) {
      const auto i = static_cast<std::size_t>(index);
      const Result<Evaluation> run = evaluators_.of(worker).run(all[i].spec);
      ran[i] = run.ok();
      fails[i] = run && std::ranges::any_of(run->findings, [&](const Finding& finding) {
        return kind_of_check(finding.check) == kind_;
      });
    }, [] {});
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
  const Population& population_;
  Generator& generator_;
  Evaluators evaluators_;
  const ConditionSearch& options_;
  std::int64_t next_to_learn_ = 0;  // indices of draws
  std::int64_t next_fresh_ = kFirstFresh;
};

std::vector<Conjunction> learned(const std::vector<RuleSample>& samples, int failing) {
  if (!samples.empty() && failing >= kAlwaysFrom * static_cast<double>(samples.size())) return {{}};
  const std::optional<std::vector<Conjunction>> rule = learn_rule(samples);
  return rule ? *rule : std::vector<Conjunction>{};
}

// Enough failing and passing cases, or hardly any that pass.
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
                  .headline = cause_headline(cause, minimal.expect.check, minimal.expect.subject),
                  .character = minimal.spec.character.name,
                  .character_hash = minimal.expect.character_hash,
                  .tool = options.tool,
                  .learned_from = spec_id(minimal.spec),
                  .needs = needs_of(cause)};
  Search search(minimal, *population, generator, settings, options);
  std::vector<RuleSample> samples;
  for (int round = 0; round < kMostRounds && !has_rule(found); ++round) {
    search.learn_more(samples);
    found.drawn = static_cast<int>(samples.size());
    found.failing = static_cast<int>(std::ranges::count_if(samples, &RuleSample::fails));
    if (!has_enough(found) && round + 1 < kMostRounds) continue;
    found.any_of = learned(samples, found.failing);
    if (has_rule(found)) found.trial = search.trial(found.any_of);
    if (has_rule(found) && !is_told(found)) found.any_of.clear(), found.trial = {};
  }
  return found;
}

}  // namespace contort
