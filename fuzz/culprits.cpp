#include "fuzz/culprits.h"

#include <algorithm>
#include <map>
#include <set>

#include "checks/circumstances.h"
#include "corpus/ending_case.h"

namespace contort {

namespace {

// A spec with more actions was not shrunk; then all its actions count as company.
constexpr std::size_t kMostExperiments = 16;

// Returns true if a finding is of the same kind as the failure, and on one of its limbs.
bool is_alike(const Finding& finding, const Expectation& failure) {
  if (kind_of_check(finding.check) != kind_of_check(failure.check)) return false;
  const std::vector<std::string> limbs = limbs_of(failure.subject);
  return std::ranges::any_of(limbs_of(finding.subject), [&](const std::string& limb) {
    return std::ranges::binary_search(limbs, limb);
  });
}

class Experiments {
 public:
  Experiments(const Case& minimal, Evaluator& evaluator, const CauseSearch& search)
      : minimal_(minimal), evaluator_(evaluator), search_(search) {}

  // The depth of the deepest finding like the failure while this action plays alone; negative if there is none.
  double depth_alone(const LoneAction& one) {
    Spec spec = minimal_.spec;
    spec.interrupts.clear();
    spec.sequences = {one.sequence};
    spec.only_sequence = spec.only_clip = 0;
    double depth = -1.0;
    if (const std::optional<Evaluation> run = evaluate(spec))
      for (const Finding& finding : run->findings)
        if (is_alike(finding, minimal_.expect)) depth = std::max(depth, finding.depth);
    return depth;
  }

  // The names of the actions that move the figure in the worst frame.
  std::set<std::string> actions_in_force() {
    std::set<std::string> names;
    const std::optional<Evaluation> run = evaluate(minimal_.spec);
    const Execution& execution = evaluator_.execution();
    if (!run || !execution.intent || minimal_.expect.worst_frame >= execution.motion.frame_count) return names;
    for (const ActiveAction& action : circumstances_of(*execution.intent, *execution.character, execution.motion,
                                                       minimal_.expect.worst_frame).actions)
      names.insert(action.name);
    return names;
  }

  std::vector<Case> take_met() { return std::move(met_); }

 private:
  // Returns no evaluation if the spec is refused or ends its process.
  std::optional<Evaluation> evaluate(const Spec& spec) {
    if (search_.guard && ends_its_process(spec)) return std::nullopt;
    Result<Evaluation> run = run_noted(spec);
    if (!run) return std::nullopt;
    return std::move(run).value();
  }

  Result<Evaluation> run_noted(const Spec& spec) {
    if (search_.before_run) search_.before_run(spec);
    return evaluator_.run(spec);
  }

  // Also returns false if no process can be started; the spec then runs in this one.
  bool ends_its_process(const Spec& spec) {
    Isolation guard = *search_.guard;
    guard.silent = true;
    const auto work = [&] { return (void)run_noted(spec), std::string(); };
    const Result<Ending> ending = isolate(work, guard);
    if (!ending || ending->kind == Ending::Kind::finished) return false;
    met_.push_back(ending_case(spec, *ending, guard));
    return true;
  }

  const Case& minimal_;
  Evaluator& evaluator_;
  const CauseSearch& search_;
  std::vector<Case> met_;
};

// The names of actions that fail alone, the deepest first, equally deep ones by name.
std::vector<std::string> culprits_of(const Spec& minimal, Experiments& experiments) {
  std::map<std::string, double> depths;
  for (const LoneAction& one : lone_actions_of(minimal))
    if (const double depth = experiments.depth_alone(one); depth >= 0.0)
      depths[one.action] = std::max(depths[one.action], depth);
  std::vector<std::string> names;
  for (const auto& [name, depth] : depths) names.push_back(name);
  std::ranges::stable_sort(names, std::greater(), [&](const std::string& name) { return depths.at(name); });
  return names;
}

}  // namespace

FoundCause find_cause(const Case& minimal, Evaluator& evaluator, const CauseSearch& search) {
  Cause cause = cause_without_experiments(minimal.spec);
  if (cause.scope != CauseScope::company || is_abnormal_exit(minimal.expect)) return {cause, {}};
  Experiments experiments(minimal, evaluator, search);
  std::vector<std::string> culprits;
  if (lone_actions_of(minimal.spec).size() <= kMostExperiments) culprits = culprits_of(minimal.spec, experiments);
  if (!culprits.empty()) {
    cause.scope = CauseScope::alone;
    cause.names = {culprits.front()};
    cause.also.assign(culprits.begin() + 1, culprits.end());
    std::ranges::sort(cause.also);
  } else if (const std::set<std::string> in_force = experiments.actions_in_force(); !in_force.empty()) {
    cause.names.assign(in_force.begin(), in_force.end());
  }
  return {cause, experiments.take_met()};
}

}  // namespace contort
