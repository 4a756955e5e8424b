#include "fuzz/case_work.h"

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "corpus/ending_case.h"
#include "process/clock.h"
#include "corpus/replay.h"
#include "fuzz/case_fields.h"
#include "fuzz/departures.h"
#include "fuzz/labels.h"
#include "fuzz/precursor.h"
#include "model/core/hash.h"

namespace contort {

namespace {

constexpr double kWithinReach = 20.0;  // of a limit, in the check's scale: 2 rad, 40 cm

std::string target_of(const CheckDef& check, const Character& character, std::size_t subject) {
  return std::string(check.name) + "|" + character.name() + "|" +
         check.subject(character, static_cast<int>(subject)).name;
}

// The earliest first, as what comes later may only follow from it; of those that begin together the deepest.
std::vector<std::string> families_of(const std::string& character, std::vector<Finding> findings) {
  std::ranges::stable_sort(findings, [](const Finding& l, const Finding& r) {
    return std::pair(l.first_frame, -l.depth) < std::pair(r.first_frame, -r.depth);
  });
  std::vector<std::string> families;
  std::set<std::string> seen;
  for (const Finding& finding : findings)
    if (const std::string family = family_of(character, finding); seen.insert(family).second)
      families.push_back(family);
  return families;
}

// The deepest finding of the family, or none.
const Finding* deepest_of(const std::string& character, const std::vector<Finding>& findings,
                          const std::string& family) {
  for (const Finding& finding : findings)
    if (family_of(character, finding) == family) return deepest(findings, finding.check, finding.subject);
  return nullptr;
}

}  // namespace

const std::vector<std::int8_t>& TargetGroups::of(const CheckDef& check, const Character& character,
                                                 std::size_t subjects) {
  std::vector<std::int8_t>& groups = known_[{check.name, character.name(), character.hash()}];
  for (std::size_t s = groups.size(); s < subjects; ++s)
    groups.push_back(static_cast<std::int8_t>(group_of_target(target_of(check, character, s))));
  return groups;
}

CaseWork::CaseWork(const RunConfig& config, Generator& generator, const Corpus& corpus)
    : config_(config), generator_(generator), corpus_(corpus), evaluator_(generator, config.checks) {}

std::string CaseWork::operator()(const std::string& text, WorkerSlot& slot) {
  const CaseTask task = parse_task(text);
  const CaseReport report = !task.lead.empty()    ? shrink_waiting(task, slot)
                            : task.family.empty() ? evaluate(task, slot)
                                                  : settle(task, slot);
  return json_fields::write_canonical(report);
}

CaseReport CaseWork::evaluate(const CaseTask& task, WorkerSlot& slot) {
  CaseReport report;
  const Spec spec = spec_of(config_, generator_, task.lineage);
  slot.note(print_spec(spec));
  const Result<Evaluation> run = evaluator_.run(spec);
  if (!run) return report;
  const Evaluation& evaluation = *run;
  const Execution& execution = evaluator_.execution();
  report.built = true;
  report.tested = labels_of(spec, generator_, execution);
  report.frames = evaluation.frame_count;
  report.motion_hash = to_hex(evaluation.motion_hash);
  report.waivers = evaluation.waivers;
  report.broken = families_of(spec.character.name, evaluation.findings);
  const std::int64_t index = task.lineage.back();
  if (!is_seed(config_, index)) report.near = near_misses(*execution.character, group_of(index));
  return report;
}

// Of the subjects of `group`, those that came within reach of their limit and did not break it.
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

// "crash|human|SIGSEGV" back to how the process ended; nothing for a family of a check.
std::optional<Ending> ending_of(const std::string& family) {
  const FamilyParts parts = family_parts(family);
  if (parts.check == "crash") return Ending{Ending::Kind::crash, parts.subject, {}};
  if (parts.check == "timeout") return Ending{Ending::Kind::timeout, {}, {}};
  if (parts.check == "memory") return Ending{Ending::Kind::memory, {}, {}};
  return std::nullopt;
}

}  // namespace

Case seen_once(const CaseTask& task, const Spec& spec, Generator& generator, const WorkerLimits& limits) {
  if (const std::optional<Ending> ending = ending_of(task.family))
    return ending_case(spec, *ending, isolation_of(limits));
  Case seen{spec, {}, {}};
  const FamilyParts parts = family_parts(task.family);
  seen.expect.check = parts.check, seen.expect.subject = parts.subject;
  seen.expect.worst_margin = std::numeric_limits<double>::quiet_NaN();
  seen.expect.motion_hash = task.motion_hash;
  const Result<Character> character = build_character(spec.character, *generator.manifest().library);
  seen.expect.character_hash = to_hex(character ? character->hash() : 0);
  return seen;
}

// The failure as the second time shows it, or nothing.
std::optional<Case> CaseWork::shown_again(const CaseTask& task, const Spec& spec) {
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

// Kept first, then shrunk, so that a kill at any point loses nothing.
CaseReport CaseWork::settle(const CaseTask& task, WorkerSlot& slot) {
  CaseReport report;
  const Spec spec = spec_of(config_, generator_, task.lineage);
  slot.note(print_spec(spec));
  const std::optional<Case> again = shown_again(task, spec);
  Lead lead{run_name(config_), again ? *again : seen_once(task, spec, generator_, config_.limits), {}};
  Provenance& from = lead.original.provenance;
  from = provenance_in(config_, task.lineage.back());
  from.rank = task.rank;
  report.confirmed = again && (is_ending(again->expect) || again->expect.motion_hash == task.motion_hash);
  from.shrink_stopped = !report.confirmed ? kUnsteady : task.shrinks ? "" : kWaits;
  Result<std::string> kept = keep_lead(corpus_, lead);
  if (kept && report.confirmed && task.shrinks) kept = shrink_lead(task, lead, report, slot);
  if (!kept) report.issue = kept.issue().text;
  return report;
}

// Of an earlier run, or of this one before. Another process may have taken it meanwhile; then there is nothing to do.
CaseReport CaseWork::shrink_waiting(const CaseTask& task, WorkerSlot& slot) {
  CaseReport report;
  Result<Lead> read = read_lead(task.lead);
  if (!read) return report;
  Lead lead = std::move(read).value();
  slot.note(print_spec(lead.original.spec));
  lead.original.provenance.shrink_stopped.clear();
  if (const Result<std::string> kept = shrink_lead(task, lead, report, slot); !kept) report.issue = kept.issue().text;
  return report;
}

namespace {

void take_shrunk(const Shrunk& shrunk, Lead& lead, CaseReport& report) {
  lead.minimal = shrunk.minimal, lead.worst = shrunk.worst;
  report.also = shrunk.minimal.also;
  if (family_of(shrunk.minimal) == family_of(lead.original)) return;
  lead.shrunk_from = shrunk.original;
  report.also.push_back(family_of(shrunk.minimal));
}

}  // namespace

// What shrank in this process at first is shrunk with a guard once a candidate has ended that.
Result<std::string> CaseWork::shrink_lead(const CaseTask& task, Lead& lead, CaseReport& report,
                                          WorkerSlot& slot) const {
  const bool guarded = !task.ending.empty();
  const Shrunk shrunk = shrink_to_precursor(lead.original, [&](const Case& original, const Onward& onward) {
    return shrink_one(original, lead.run, guarded, slot, onward);
  });
  report.confirmed = shrunk.stopped != "flaky" && shrunk.stopped != "gone";
  if (report.confirmed)
    take_shrunk(shrunk, lead, report);
  else
    lead.original.provenance.shrink_stopped = kUnsteady;
  Result<std::string> kept = keep_lead(corpus_, lead);
  for (const Case& met : shrunk.met)
    if (kept && is_ending(met.expect)) kept = keep_met(lead, met, report, slot);
  return kept;
}

// A spec that ends its process is a failure of its own, whatever was being shrunk. What is met while this one is shrunk
// is not followed any further.
Result<std::string> CaseWork::keep_met(const Lead& shrunk, const Case& met, CaseReport& report,
                                       WorkerSlot& slot) const {
  Lead lead{shrunk.run, met, {}};
  lead.original.provenance = shrunk.original.provenance;
  lead.original.provenance.met_shrinking = family_of(shrunk.original);
  const Shrunk smaller = shrink_one(lead.original, lead.run, false, slot, {});
  const bool again = smaller.stopped != "flaky" && smaller.stopped != "gone";
  if (again) lead.minimal = smaller.minimal;
  (again ? report.met : report.met_once).push_back(family_of(met));
  return keep_lead(corpus_, lead);
}

// A failure is shrunk within the profile that found it, as far as that is known.
std::function<bool(const Spec&)> CaseWork::allowed_for(const Case& original, const std::string& run) const {
  if (run == run_name(config_)) return within(config_.draw.profile, original.spec, generator_);
  for (const Profile& profile : built_in_profiles())
    if (profile.name == original.provenance.profile) return within(profile, original.spec, generator_);
  return {};
}

Shrunk CaseWork::shrink_one(const Case& original, const std::string& run, bool guarded, WorkerSlot& slot,
                            const Onward& onward) const {
  ShrinkConfig config = config_.shrink;
  config.onward = onward;
  config.checks = config_.checks;
  config.isolation = isolation_of(config_.limits);
  config.guarded = guarded;
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

std::string print_task(const CaseTask& task) { return json_fields::write_canonical(task); }

namespace {

// Both ends of a message are this program.
template <class T>
T parsed(const std::string& text) {
  Result<T> value = json_fields::read_document<T>(text, "message");
  if (!value) throw std::logic_error(to_line(value.issue()));
  return std::move(value).value();
}

}  // namespace

CaseTask parse_task(const std::string& text) { return parsed<CaseTask>(text); }
CaseReport parse_report(const std::string& text) { return parsed<CaseReport>(text); }

}  // namespace contort
