#include "fuzz/case_work.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>

#include "fuzz/case_fields.h"
#include "fuzz/compose.h"
#include "fuzz/labels.h"
#include "generator/core/hash.h"

namespace contort {

namespace {

constexpr double kWithinReach = 20.0;  // of a limit, in the check's scale: 2 rad, 40 cm

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Of the subjects that fall to `island`, those that came within reach of their limit and did not break it.
std::vector<NearMiss> near_misses(const Character& character, const std::vector<SmallestMargins>& smallest,
                                  int island) {
  std::vector<NearMiss> near;
  for (const SmallestMargins& margins : smallest)
    for (std::size_t s = 0; s < margins.of_subject.size(); ++s) {
      const double margin = margins.of_subject[s] / margins.check->scale;
      if (!(margin >= 0.0 && margin <= kWithinReach)) continue;
      const std::string family = std::string(margins.check->name) + "|" + character.name() + "|" +
                                 margins.check->subject(character, static_cast<int>(s)).name;
      if (island_of_target(family) == island) near.push_back({family, margin});
    }
  return near;
}

std::vector<std::string> families_of(const std::string& character, const std::vector<Finding>& findings) {
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

CaseWork::CaseWork(const RunConfig& config, const Library& library, const Corpus& corpus)
    : config_(config), library_(library), corpus_(corpus), evaluator_(config.checks) {}

std::string CaseWork::operator()(const std::string& text, WorkerSlot& slot) {
  const CaseTask task = parse_task(text);
  return json_fields::write_canonical(task.family.empty() ? evaluate(task, slot) : settle(task, slot));
}

Spec CaseWork::spec_of(const CaseTask& task) const {
  return compose(raw_of(config_.seed, task.lineage), config_.draw, library_);
}

CaseReport CaseWork::evaluate(const CaseTask& task, WorkerSlot& slot) {
  CaseReport report;
  const Spec spec = spec_of(task);
  slot.note(print_spec(spec));
  const Result<Stage> stage = build_stage(spec, library_);
  if (!stage) return report;
  report.built = true;
  report.tested = labels_of(spec, *stage);
  const Evaluation evaluation = evaluator_.run(*stage);
  report.frames = evaluation.frame_count;
  report.motion_hash = to_hex(evaluation.motion_hash);
  report.waivers = evaluation.waivers;
  report.broken = families_of(spec.character.name, evaluation.findings);
  report.near = near_misses(*stage->character, evaluator_.smallest_margins(), island_of(task.lineage.back()));
  return report;
}

// Kept first, then shrunk, so that a kill at any point loses nothing.
CaseReport CaseWork::settle(const CaseTask& task, WorkerSlot& slot) {
  CaseReport report;
  const Spec spec = spec_of(task);
  slot.note(print_spec(spec));
  const Result<Stage> stage = build_stage(spec, library_);
  if (!stage) return report;
  report.built = true;
  const Evaluation evaluation = evaluator_.run(*stage);
  const Finding* finding = deepest_of(spec.character.name, evaluation.findings, task.family);
  if (finding == nullptr) return report;
  Lead lead{run_name(config_), {spec, expectation_of(*stage, evaluator_.motion(), evaluation, *finding), {}}, {}};
  lead.original.provenance = {config_.tool, config_.seed, task.lineage.back(), "", 0, ""};
  report.confirmed = lead.original.expect.motion_hash == task.motion_hash;
  Result<std::string> kept = keep_lead(corpus_, lead);
  if (kept && report.confirmed) {
    lead.minimal = shrunk(task, lead.original, slot);
    kept = keep_lead(corpus_, lead);
  }
  if (!kept) report.issue = kept.issue().text;
  return report;
}

Case CaseWork::shrunk(const CaseTask& task, const Case& original, WorkerSlot& slot) const {
  ShrinkConfig config = config_.shrink;
  config.checks = config_.checks;
  if (!task.ending.empty()) config.max_evaluations = 0;  // a candidate ended the process that tried it
  config.out_of_time = [&] {
    slot.beat();
    return config_.deadline_s > 0.0 && steady_s() >= config_.deadline_s;
  };
  return shrink(original, library_, config);
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
