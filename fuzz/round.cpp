#include "fuzz/round.h"

#include <algorithm>
#include <utility>

namespace contort {

void Round::add(const Lineage& lineage) {
  cases_.push_back({lineage});
  ++open_;
}

std::optional<int> Round::next() {
  if (!again_.empty()) {
    const int place = again_.back();
    again_.pop_back();
    return place;
  }
  if (given_ < size()) return given_++;
  return std::nullopt;
}

EvaluateTask Round::task(int place) const {
  const RoundCase& of_round = cases_[static_cast<std::size_t>(place)];
  return {of_round.lineage, of_round.ends};
}

void Round::close(int place, EvaluateReport report) {
  cases_[static_cast<std::size_t>(place)].report = std::move(report);
  --open_;
}

void Round::take_report(int place, EvaluateReport report) { close(place, std::move(report)); }

void Round::take_ending(int place, const Case& ended, bool is_known) {
  RoundCase& of_round = cases_[static_cast<std::size_t>(place)];
  if (of_round.ends.empty() && !of_round.ended_once && !is_known) {
    of_round.ended_once = ended;
    return again_.push_back(place);
  }
  of_round.ended_once.reset();
  of_round.ends_process = true;
  if (asks_base_ && of_round.ends.empty()) {
    of_round.ends = family_of(ended);
    return again_.push_back(place);
  }
  EvaluateReport report;
  report.built = true;
  report.broken = {of_round.ends.empty() ? family_of(ended) : of_round.ends};
  if (asks_base_) report.against.emplace().refusal = "the worker that asked the base ended";
  close(place, std::move(report));
}

bool Round::has_failure() const {
  return std::ranges::any_of(
      cases_, [](const RoundCase& one) { return one.report && !counted_families(*one.report).empty(); });
}

}  // namespace contort
