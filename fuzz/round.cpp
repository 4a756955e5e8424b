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

void Round::close(int place, EvaluateReport report) {
  cases_[static_cast<std::size_t>(place)].report = std::move(report);
  --open_;
}

void Round::take_report(int place, EvaluateReport report) { close(place, std::move(report)); }

void Round::take_ending(int place, const Case& ended, bool is_known) {
  RoundCase& of_round = cases_[static_cast<std::size_t>(place)];
  if (!of_round.ended_once && !is_known) {
    of_round.ended_once = ended;
    return again_.push_back(place);
  }
  of_round.ended_once.reset();
  of_round.ends_process = true;
  EvaluateReport report;
  report.built = true;
  report.broken = {family_of(ended)};
  close(place, std::move(report));
}

bool Round::has_failure() const {
  return std::ranges::any_of(cases_, [](const RoundCase& one) { return one.report && !one.report->broken.empty(); });
}

}  // namespace contort
