#include "corpus/condition.h"

#include <algorithm>
#include <cmath>

#include "model/core/number_text.h"

namespace contort {

namespace {

double share(int part, int of) { return of > 0 ? static_cast<double>(part) / of : 0.0; }

double f1_of(const RuleTrial& trial) {
  const double precision = precision_of(trial), recall = recall_of(trial);
  return precision + recall > 0.0 ? 2.0 * precision * recall / (precision + recall) : 0.0;
}

std::string quantity_text(const ConditionTerm& term) {
  const std::string name = term.is_mirrored ? term.name + " (as on the left)" : term.name;
  switch (term.quantity) {
    case known::Quantity::value: return name;
    case known::Quantity::magnitude: return "|" + name + "|";
    case known::Quantity::per_second: return name + " per second";
    case known::Quantity::magnitude_per_second: return "|" + name + "| per second";
    case known::Quantity::times_seconds: return name + " times seconds";
  }
  return name;
}

std::string term_text(const ConditionTerm& term) {
  switch (term.op) {
    case known::Op::below: return quantity_text(term) + " < " + number_text(term.limit);
    case known::Op::above: return quantity_text(term) + " > " + number_text(term.limit);
    case known::Op::is: return term.name + " is " + term.word;
    case known::Op::is_not: return term.name + " is not " + term.word;
  }
  return term.name;
}

std::string conjunction_text(const Conjunction& all) {
  std::string text;
  for (const ConditionTerm& term : all) text += (text.empty() ? "" : " and ") + term_text(term);
  return text.empty() ? "always" : text;
}

std::string percent(double part) { return std::to_string(static_cast<int>(std::floor(100.0 * part + 0.5))) + " %"; }

known::Term comparison_of(const ConditionTerm& term) {
  return {term.name, term.quantity, term.is_mirrored, term.op, term.limit, term.word};
}

auto key_of(const Condition& condition) { return std::tie(condition.cause, condition.character); }

}  // namespace

std::span<const std::string_view> quantity_names() {
  static constexpr std::string_view kNames[] = {"value", "magnitude", "per_second", "magnitude_per_second",
                                                "times_seconds"};
  return kNames;
}

std::span<const std::string_view> op_names() {
  static constexpr std::string_view kNames[] = {"below", "above", "is", "is_not"};
  return kNames;
}

double precision_of(const RuleTrial& trial) { return share(trial.inside_failing, trial.inside); }

double failing_outside(const RuleTrial& trial) { return share(trial.outside_failing, trial.outside); }

double recall_of(const RuleTrial& trial) {
  const double inside = trial.inside_share * precision_of(trial);
  const double outside = (1.0 - trial.inside_share) * failing_outside(trial);
  return inside > 0.0 ? inside / (inside + outside) : 0.0;
}

std::string rule_text(const std::vector<Conjunction>& any_of) {
  std::string text;
  for (const Conjunction& all : any_of) text += (text.empty() ? "" : ", or ") + conjunction_text(all);
  return text;
}

std::string condition_text(const Condition& condition) {
  const RuleTrial& trial = condition.trial;
  if (!has_rule(condition))
    return "No rule of at most " + std::to_string(kMostComparisons) + " comparisons tells when it fails (" +
           percent(share(condition.failing, condition.drawn)) + " of " + std::to_string(condition.drawn) +
           " drawn cases do).";
  const std::string inside =
      "Fails in " + percent(precision_of(trial)) + " of " + std::to_string(trial.inside) + " fresh cases";
  if (trial.outside == 0) return inside + ", whatever their values are.";
  return inside + " where " + rule_text(condition.any_of) + ", and in " + percent(failing_outside(trial)) + " of " +
         std::to_string(trial.outside) + " others.";
}

RuleTable::RuleTable(std::vector<Condition> conditions) : conditions_(std::move(conditions)) {
  std::erase_if(conditions_, [](const Condition& condition) { return !has_rule(condition); });
  std::size_t alls = 0;
  for (const Condition& condition : conditions_) alls += condition.any_of.size();
  comparisons_.reserve(alls);
  alls_.reserve(conditions_.size()), needs_.reserve(conditions_.size()), texts_.reserve(conditions_.size());
  for (const Condition& condition : conditions_) {
    std::vector<known::All>& any_of = alls_.emplace_back();
    for (const Conjunction& all : condition.any_of) {
      std::vector<known::Term>& comparisons = comparisons_.emplace_back();
      for (const ConditionTerm& term : all) comparisons.push_back(comparison_of(term));
      any_of.push_back({comparisons});
    }
    const std::vector<std::string_view>& needs = needs_.emplace_back(condition.needs.begin(), condition.needs.end());
    const std::string& text = texts_.emplace_back(condition.headline + ": " + condition_text(condition));
    rules_.push_back({condition.cause, text, condition.character, needs, any_of, precision_of(condition.trial),
                      recall_of(condition.trial)});
  }
}

std::vector<Condition> merged_conditions(std::vector<Condition> all) {
  std::ranges::stable_sort(all, [](const Condition& a, const Condition& b) {
    if (key_of(a) != key_of(b)) return key_of(a) < key_of(b);
    if (f1_of(a.trial) != f1_of(b.trial)) return f1_of(a.trial) > f1_of(b.trial);
    return print_conditions({a}) < print_conditions({b});
  });
  const auto doubles = std::unique(all.begin(), all.end(), [](const Condition& a, const Condition& b) {
    return key_of(a) == key_of(b);
  });
  all.erase(doubles, all.end());
  return all;
}

}  // namespace contort
