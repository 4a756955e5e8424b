#include "fuzz/case_work.h"

#include <algorithm>
#include <limits>
#include <set>

#include "corpus/ending_case.h"
#include "corpus/refusals.h"
#include "process/clock.h"
#include "corpus/replay.h"
#include "fuzz/profile_violations.h"
#include "fuzz/culprits.h"
#include "fuzz/labels.h"
#include "fuzz/precursor.h"
#include "model/core/hash.h"

namespace contort {

namespace {

// Smallest distance to a limit that is no near miss, in the check's scale: 2 rad, 40 cm.
constexpr double kWithinReach = 20.0;

Family target_of(const CheckDef& check, const Character& character, std::size_t subject) {
  return {std::string(check.name), character.name(), check.subject(character, static_cast<int>(subject)).name};
}

// The earliest family comes first, because later ones may only follow from it; of equally early ones the deepest.
std::vector<Family> families_of(const std::string& character, std::vector<Finding> findings) {
  std::ranges::stable_sort(findings, [](const Finding& l, const Finding& r) {
    return std::pair(l.first_frame, -l.depth) < std::pair(r.first_frame, -r.depth);
  });
  std::vector<Family> families;
  std::set<Family> seen;
  for (const Finding& finding : findings)
    if (const Family family = family_of(character, finding); seen.insert(family).second)
      families.push_back(family);
  return families;
}

// The deepest finding of the family, or none.
const Finding* deepest_of(const std::string& character, const std::vector<Finding>& findings, const Family& family) {
  for (const Finding& finding : findings)
    if (family_of(character, finding) == family) return deepest(findings, finding.check, finding.subject);
  return nullptr;
}

Result<Done> done(const Result<std::string>& kept) { return kept ? Result<Done>(Done{}) : kept.issue(); }

}  // namespace

const std::vector<std::int8_t>& TargetGroups::of(const CheckDef& check, const Character& character,
                                                 std::size_t subjects) {
  std::vector<std::int8_t>& groups = known_[{check.name, character.name(), character.hash()}];
  for (std::size_t s = groups.size(); s < subjects; ++s)
    groups.push_back(static_cast<std::int8_t>(group_of_target(target_of(check, character, s))));
  return groups;
}

CaseWork::CaseWork(const RunConfig& config, Generator& generator, const Corpus& corpus)
    : config_(config), generator_(generator), corpus_(corpus), evaluator_(generator, config.checks) {
  if (config.against) against_.emplace(*config.against);
}

std::string CaseWork::operator()(const std::string& text, WorkerSlot& slot) {
  struct Doing {
    CaseWork& work;
    WorkerSlot& slot;
    std::string operator()(const EvaluateTask& task) const { return print_report(work.evaluate(task, slot)); }
    std::string operator()(const SettleTask& task) const { return print_report(work.settle(task, slot)); }
    std::string operator()(const ShrinkTask& task) const { return print_report(work.shrink_waiting(task, slot)); }
  };
  return std::visit(Doing{*this, slot}, parse_task(text));
}

// Evaluates a case. If there is a base, both builds work at the same time.
EvaluateReport CaseWork::evaluate(const EvaluateTask& task, WorkerSlot& slot) {
  EvaluateReport report;
  const Spec spec = spec_of(config_, generator_, task.lineage);
  slot.note(print_spec(spec));
  if (against_ && !task.ends.empty()) {
    report.built = true, report.broken = {task.ends};
    report.against = against_->compare_ending(spec, task.ends, slot);
    return report;
  }
  if (against_) against_->begin(spec);
  const Result<Evaluation> run = evaluator_.run(spec);
  if (run) report = report_of(task, spec, *run);
  if (!run) report.refusal = reason_of(run.issue());
  if (run && against_) report.against = against_->compare(spec, *run, evaluator_, slot);
  if (!run && against_) against_->drop(slot);
  return report;
}

EvaluateReport CaseWork::report_of(const EvaluateTask& task, const Spec& spec, const Evaluation& evaluation) {
  EvaluateReport report;
  const Execution& execution = evaluator_.execution();
  report.built = true;
  report.tested = labels_of(spec, generator_, execution);
  report.unmet = unmet_labels(execution);
  report.not_judged = not_judged_labels(evaluation.not_judged);
  report.frames = evaluation.frame_count;
  report.motion_hash = to_hex(evaluation.motion_hash);
  report.waivers = evaluation.waivers;
  report.broken = families_of(spec.character.name, evaluation.findings);
  const std::int64_t index = task.lineage.back();
  if (!is_seed(config_, index) && !config_.draw.profile.staged) report.near = near_misses(*execution.character, group_of(index));
  return report;
}

// Lists the subjects of `group` that came near their limit (kWithinReach) without breaking it.
std::vector<NearMiss> CaseWork::near_misses(const Character& character, int group) {
  std::vector<NearMiss> near;
  for (const SmallestMargins& margins : evaluator_.smallest_margins()) {
    const std::vector<std::int8_t>& groups = groups_.of(*margins.check, character, margins.of_subject.size());
    for (std::size_t s = 0; s < margins.of_subject.size(); ++s) {
      const double margin = margins.of_subject[s] / margins.check->scale;
      if (groups[s] == group && margin >= 0.0 && margin <= kWithinReach)
        near.push_back({target_of(*margins.check, character, s), margin});
    }
  }
  return near;
}

namespace {

// The ending of a process that this family describes; empty for a family of a check.
std::optional<Ending> ending_of(const Family& family) {
  if (family.check == "crash") return Ending{Ending::Kind::crash, family.subject, {}};
  if (family.check == "timeout") return Ending{Ending::Kind::timeout, {}, {}};
  if (family.check == "memory") return Ending{Ending::Kind::memory, {}, {}};
  return std::nullopt;
}

}  // namespace

Case seen_once(const SettleTask& task, const Spec& spec, Generator& generator, const WorkerLimits& limits) {
  if (const std::optional<Ending> ending = ending_of(task.family))
    return ending_case(spec, *ending, isolation_of(limits));
  Case seen{spec, {}, {}};
  seen.expect.check = task.family.check, seen.expect.subject = task.family.subject;
  seen.expect.worst_margin = std::numeric_limits<double>::quiet_NaN();
  seen.expect.motion_hash = task.motion_hash;
  const Result<Character> character = build_character(spec.character, *generator.manifest().library);
  seen.expect.character_hash = to_hex(character ? character->hash() : 0);
  return seen;
}

// The failure as the second run shows it; empty if it does not show it.
std::optional<Case> CaseWork::shown_again(const SettleTask& task, const Spec& spec) {
  if (const std::optional<Ending> ending = ending_of(task.family)) {
    const Case ended = ending_case(spec, *ending, isolation_of(config_.limits));
    const Replay again = replay(ended, evaluator_, {}, isolation_of(config_.limits));
    return again.verdict == Verdict::same ? std::optional<Case>(ended) : std::nullopt;
  }
  const Result<Evaluation> evaluation = evaluator_.run(spec);
  if (!evaluation) return std::nullopt;
  const Finding* finding = deepest_of(spec.character.name, evaluation->findings, task.family);
  if (finding == nullptr) return std::nullopt;
  return Case{spec, expectation_of(evaluator_.execution(), *evaluation, *finding), {}};
}

// Stores the failure before shrinking it, so that a kill at any point loses nothing.
SettleReport CaseWork::settle(const SettleTask& task, WorkerSlot& slot) {
  SettleReport report;
  const Spec spec = spec_of(config_, generator_, task.lineage);
  slot.note(print_spec(spec));
  const std::optional<Case> again = shown_again(task, spec);
  SettledLead& settled = report.settled;
  settled.lead = {run_name(config_), again ? *again : seen_once(task, spec, generator_, config_.limits), {}};
  Provenance& from = settled.lead.original.provenance;
  from = provenance_in(config_, task.lineage.back());
  from.rank = task.rank;
  settled.confirmed = again && (is_abnormal_exit(again->expect) || again->expect.motion_hash == task.motion_hash) &&
                      counts_again(settled.lead.original, task.base_hash, slot);
  from.shrink_stopped = !settled.confirmed ? kUnsteady : task.shrinks ? "" : kWaits;
  Result<Done> kept = done(keep_lead(corpus_, settled.lead));
  if (kept && settled.confirmed && task.shrinks) kept = shrink_lead(settled, task.guarded, slot);
  if (!kept) report.issue = kept.issue().text;
  return report;
}

// Returns true if the failure counts in a second run against the base, or if there is no base.
bool CaseWork::counts_again(Case& found, const std::string& base_hash, WorkerSlot& slot) {
  return !against_ || against_->confirm(found, evaluator_, base_hash, slot);
}

// Shrinks a lead of an earlier run, or of this run before it was stopped. If another process has taken the lead
// meanwhile, there is nothing to do.
ShrinkReport CaseWork::shrink_waiting(const ShrinkTask& task, WorkerSlot& slot) {
  ShrinkReport report;
  Result<Lead> read = read_lead(task.lead);
  if (!read) return report;
  SettledLead& settled = report.shrunk.emplace(SettledLead{std::move(read).value(), false, {}, {}});
  slot.note(print_spec(settled.lead.original.spec));
  settled.lead.original.provenance.shrink_stopped.clear();
  if (const Result<Done> kept = shrink_lead(settled, task.guarded, slot); !kept) report.issue = kept.issue().text;
  return report;
}

namespace {

bool shows_again(const Shrunk& shrunk) { return shrunk.stopped != "flaky" && shrunk.stopped != "gone"; }

}  // namespace

// Sets the shrunk cases of a lead. If there is a base, the smallest and the deepest case are run again in both builds.
// Returns false if the smallest does not count there. If the deepest does not count, the smallest replaces it.
bool CaseWork::take_shrunk(Shrunk& shrunk, Lead& lead, bool guarded, WorkerSlot& slot) {
  Case minimal = shrunk.minimal, worst = shrunk.worst;
  if (!counts_again(minimal, "", slot)) return false;
  CauseSearch search{[&](const Spec& spec) { slot.note(print_spec(spec)); }, {}};
  if (guarded) search.guard = isolation_of(config_.limits);
  FoundCause found = find_cause(minimal, evaluator_, search);
  minimal.cause = found.cause;
  std::ranges::move(found.met, std::back_inserter(shrunk.met));
  lead.minimal = minimal;
  lead.worst = counts_again(worst, "", slot) ? worst : minimal;
  if (family_of(minimal) == family_of(lead.original)) return true;
  lead.shrunk_from = shrunk.original;
  (void)counts_again(*lead.shrunk_from, "", slot);  // sets its provenance
  return true;
}

// A lead is shrunk in this process first; with a guard after a candidate has ended that process.
Result<Done> CaseWork::shrink_lead(SettledLead& settled, bool guarded, WorkerSlot& slot) {
  Lead& lead = settled.lead;
  Shrunk shrunk = shrink_to_precursor(lead.original, [&](const Case& original, const PrimarySearch& search) {
    return shrink_one(original, lead.run, guarded, slot, search);
  });
  settled.confirmed = shows_again(shrunk) && take_shrunk(shrunk, lead, guarded, slot);
  if (!settled.confirmed) lead.original.provenance.shrink_stopped = kUnsteady;
  Result<Done> kept = done(keep_lead(corpus_, lead));
  for (const Case& met : shrunk.met)
    if (kept && is_abnormal_exit(met.expect)) kept = keep_incidental(met, settled, slot);
  return kept;
}

// A spec that ends its process is a failure of its own, and is stored and shrunk. Failures that are found during that
// shrinking are ignored.
Result<Done> CaseWork::keep_incidental(const Case& met, SettledLead& settled, WorkerSlot& slot) {
  if (against_ && against_->is_refused(met.spec, slot))
    return settled.incidental_of_base.push_back(family_of(met)), Done{};
  Lead lead{settled.lead.run, met, {}};
  lead.original.provenance = settled.lead.original.provenance;
  lead.original.provenance.met_shrinking = family_of(settled.lead.original);
  const Shrunk smaller = shrink_one(lead.original, lead.run, false, slot, {});
  Case minimal = smaller.minimal;
  const bool again = shows_again(smaller) && counts_again(minimal, "", slot);
  if (again) minimal.cause = cause_without_experiments(minimal.spec);
  if (again)
    lead.minimal = minimal;
  else
    lead.original.provenance.shrink_stopped = kUnsteady;
  (again ? settled.incidental : settled.incidental_unconfirmed).push_back(lead);
  return done(keep_lead(corpus_, lead));
}

// A failure is shrunk within the profile that found it, if that profile is known.
std::function<bool(const Spec&)> CaseWork::allowed_for(const Case& original, const std::string& run) const {
  if (run == run_name(config_)) return within(config_.draw.profile, original.spec, generator_);
  for (const Profile& profile : built_in_profiles())
    if (profile.name == original.provenance.profile) return within(profile, original.spec, generator_);
  return {};
}

Shrunk CaseWork::shrink_one(const Case& original, const std::string& run, bool guarded, WorkerSlot& slot,
                            const PrimarySearch& search) {
  ShrinkConfig config = config_.shrink;
  config.search = search;
  config.checks = config_.checks;
  config.isolation = isolation_of(config_.limits);
  config.guarded = guarded;
  if (against_) config.base = &against_->base(), config.rules = against_->rules();
  config.allowed = allowed_for(original, run);
  config.before_run = [&](const Spec& spec) {
    slot.note(print_spec(spec));
    if (config_.shrink.before_run) config_.shrink.before_run(spec);
  };
  const double start_s = steady_s();
  config.out_of_time = [&] {
    slot.beat();
    const double now_s = steady_s();
    return (config_.deadline_s > 0.0 && now_s >= config_.deadline_s) ||
           (config_.shrink_time_s > 0.0 && now_s >= start_s + config_.shrink_time_s);
  };
  return shrink(original, generator_, config);
}

}  // namespace contort
