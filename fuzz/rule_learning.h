// Learns the rule that separates failing from passing requests. docs/reference/conditions.md has the score that it
// maximises.
//
// Rules are searched by beam search over conjunctions, as in rule learners of the CN2 family (Clark and Niblett, The
// CN2 Induction Algorithm, Machine Learning 3, 1989), with F1 as the measure; a second conjunction covers what the
// first one leaves. Alhazen (Kampmann et al., ESEC/FSE 2020) explains failures by decision trees over such features.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corpus/condition.h"
#include "corpus/request.h"

namespace contort {

struct RuleSample {
  SpecRequest request;
  bool fails = false;
};

// Returns the best rule of one or two conjunctions with at most kMostComparisons comparisons in all, at least one in
// each. It returns no rule if all samples fail, if no sample fails, or if no comparison is better than calling
// everything a failure.
std::optional<std::vector<Conjunction>> learn_rule(std::span<const RuleSample> samples);

// Returns true if a rule holds for a request, by the comparison of known.h.
bool rule_holds(const std::vector<Conjunction>& any_of, const SpecRequest& request);

// Returns the decimal number with the fewest digits between two others, low < high; of several, the one in the middle.
double shortest_between(double low, double high);

}  // namespace contort
