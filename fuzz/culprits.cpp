#include "fuzz/culprits.h"

#include <algorithm>
#include <map>
#include <set>

#include "checks/circumstances.h"

namespace contort {

namespace {

constexpr std::size_t kMostExperiments = 16;  // a spec with more actions was not shrunk; then all of them are its company

// Whether a finding is of the same kind as the failure, and on one of its limbs.
bool is_alike(const Finding& finding, const Expectation& failure) {
  if (kind_of_check(finding.check) != kind_of_check(failure.check)) return false;
  const std::vector<std::string> limbs = limbs_of(failure.subject);
  return std::ranges::any_of(limbs_of(finding.subject), [&](const std::string& limb) {
    return std::ranges::binary_search(limbs, limb);
  });
}

class Experiments {
 public:
  Experiments(const Case& minimal, Evaluator& evaluator, const std::function<void(const Spec&)>& before_run)
      : minimal_(minimal), evaluator_(evaluator), before_run_(before_run) {}

  // The depth of the deepest finding like the failure while this action plays alone; below 0 if there is no such one.
  double depth_alone(const LoneAction& one) {
    Spec spec = minimal_.spec;
    spec.interrupts.clear();
    spec.sequences = {one.sequence};
    spec.only_sequence = spec.only_clip = 0;
    double depth = -1.0;
    if (const Result<Evaluation> run = evaluate(spec))
      for (const Finding& finding : run->findings)
        if (is_alike(finding, minimal_.expect)) depth = std::max(depth, finding.depth);
    return depth;
  }

  // The names of the actions that move the figure in the worst frame.
  std::set<std::string> actions_in_force() {
    std::set<std::string> names;
    const Result<Evaluation> run = evaluate(minimal_.spec);
    const Execution& execution = evaluator_.execution();
    if (!run || !execution.intent || minimal_.expect.worst_frame >= execution.motion.frame_count) return names;
    for (const ActiveAction& action : circumstances_of(*execution.intent, *execution.character, execution.motion,
                                                       minimal_.expect.worst_frame).actions)
      names.insert(action.name);
    return names;
  }

 private:
  Result<Evaluation> evaluate(const Spec& spec) {
    if (before_run_) before_run_(spec);
    return evaluator_.run(spec);
  }

  const Case& minimal_;
  Evaluator& evaluator_;
  const std::function<void(const Spec&)>& before_run_;
};

// The deepest first, of equally deep ones by name; nothing if no action fails alone.
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

Cause find_cause(const Case& minimal, Evaluator& evaluator, const std::function<void(const Spec&)>& before_run) {
  Cause cause = cause_without_experiments(minimal.spec);
  if (cause.scope != CauseScope::company || is_abnormal_exit(minimal.expect)) return cause;
  Experiments experiments(minimal, evaluator, before_run);
  std::vector<std::string> culprits;
  if (lone_actions_of(minimal.spec).size() <= kMostExperiments) culprits = culprits_of(minimal.spec, experiments);
  if (!culprits.empty()) {
    cause.scope = CauseScope::alone;
    cause.names = {culprits.front()};
    cause.also.assign(culprits.begin() + 1, culprits.end());
    std::ranges::sort(cause.also);
    return cause;
  }
  if (const std::set<std::string> in_force = experiments.actions_in_force(); !in_force.empty())
    cause.names.assign(in_force.begin(), in_force.end());
  return cause;
}

}  // namespace contort
