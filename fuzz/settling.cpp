#include "fuzz/settling.h"

#include <algorithm>
#include <filesystem>

#include "corpus/ending_case.h"
#include "corpus/leads.h"

namespace contort {

namespace {

void add_once(std::vector<std::string>& list, const std::string& name) {
  if (const auto at = std::ranges::lower_bound(list, name); at == list.end() || *at != name) list.insert(at, name);
}

CaseReport report_of(const WorkerEvent& event) {
  return event.end == WorkerEnd::replied ? parse_report(event.text) : CaseReport{};
}

}  // namespace

Case case_of_ending(const WorkerEvent& event, const Spec& given, const WorkerLimits& limits) {
  const Result<Spec> noted = parse_spec(event.note);
  return ending_case(noted ? *noted : given, ending_of(event), isolation_of(limits));
}

void Settling::go_on() { wanted_.assign(state_.wanted.begin(), state_.wanted.end()); }

void Settling::find_waiting() {
  std::vector<Issue> damaged;
  for (const Lead& lead : leads_of(corpus_, damaged)) {
    if (!waits(lead)) continue;
    CaseTask task;
    task.lineage = {lead.original.provenance.index};
    task.family = family_of(lead.original);
    task.lead = lead_path(corpus_, lead);
    waiting_.push_back(task);
  }
}

void Settling::want(const CaseTask& task) {
  state_.wanted.push_back(task);
  wanted_.push_back(task);
}

void Settling::only_keep() {
  for (CaseTask& task : wanted_) task.shrinks = false;
}

// Of one case one failure at a time: what a minimal spec shows too is not settled any more.
std::optional<CaseTask> Settling::next(bool with_waiting) {
  const auto is_free = [&](const CaseTask& task) {
    return std::ranges::none_of(in_hand_, [&](const CaseTask& other) { return other.lineage == task.lineage; });
  };
  std::deque<CaseTask>* from = &wanted_;
  auto at = std::ranges::find_if(wanted_, is_free);
  if (at == wanted_.end()) {
    if (!with_waiting || waiting_.empty()) return std::nullopt;
    from = &waiting_;
    at = waiting_.begin();
  }
  in_hand_.push_back(*at);
  from->erase(at);
  return in_hand_.back();
}

void Settling::take(const CaseTask& task, const WorkerEvent& event) {
  in_hand_.erase(std::ranges::find(in_hand_, task));
  if (task.lead.empty()) return settled(task, event);
  shrunk_waiting(task, event);
}

void Settling::settled(const CaseTask& task, const WorkerEvent& event) {
  if (event.end != WorkerEnd::replied && task.ending.empty()) return shrink_guarded(task, event);
  if (event.end != WorkerEnd::replied)
    keep_unsteady(seen_once(task, spec_of(config_, generator_, task.lineage), generator_, config_.limits), task);
  const CaseReport report = report_of(event);
  settle_no_more(task, {task.family});
  if (report.confirmed && config_.shard.count == 1) settle_no_more(task, report.also);
  if (!report.issue.empty()) return fail({"file.unwritable", "", report.issue});
  if (report.confirmed && !task.shrinks) return kept_.push_back(path_of_lead(task));
  take_lead(path_of_lead(task), report.confirmed);
  take_met(state_.record.name, task, report);
  if (task.ending.empty() || task.ending == task.family) return;
  if (std::ranges::find(report.met, task.ending) == report.met.end())
    take_lead(path_of_met(state_.record.name, task, task.ending), false);
}

// It may have been another process that did it, or this one under another name before. What ended its worker waits for
// a run with a guard: it is tried once more, like any other.
void Settling::shrunk_waiting(CaseTask task, const WorkerEvent& event) {
  const CaseReport report = report_of(event);
  if (!report.issue.empty()) return fail({"file.unwritable", "", report.issue});
  if (std::error_code error; !std::filesystem::exists(task.lead, error)) return;
  if (event.end != WorkerEnd::replied && task.ending.empty()) {
    const Result<Lead> lead = read_lead(task.lead);
    if (!lead) return;
    task.ending = family_of(case_of_ending(event, lead->original.spec, config_.limits));
    return waiting_.push_front(task);
  }
  const std::string run = std::filesystem::path(task.lead).parent_path().filename();
  take_lead(task.lead, report.confirmed);
  take_met(run, task, report);
  tidy_leads(corpus_, run);
}

// Which families of the case need no bucket of their own, a shard leaves to `merge`: it shrinks more than a whole run.
void Settling::settle_no_more(const CaseTask& of_case, const std::vector<std::string>& families) {
  const auto is_settled = [&](const CaseTask& task) {
    return task.lineage == of_case.lineage && std::ranges::find(families, task.family) != families.end();
  };
  std::erase_if(state_.wanted, is_settled);
  std::erase_if(wanted_, is_settled);
}

// A candidate of its shrinking ended the process: a failure of its own, kept at once. The guarded worker meets it
// again, or else it is not confirmed. It still comes before the later failures of its case.
void Settling::shrink_guarded(CaseTask task, const WorkerEvent& event) {
  const Spec given = spec_of(config_, generator_, task.lineage);
  Lead lead{state_.record.name, case_of_ending(event, given, config_.limits), {}};
  lead.original.provenance = provenance_in(config_, task.lineage.back());
  lead.original.provenance.met_shrinking = task.family;
  keep(lead);
  task.ending = family_of(lead.original);
  wanted_.push_front(std::move(task));
}

void Settling::take_met(const std::string& run, const CaseTask& task, const CaseReport& report) {
  for (const std::string& family : report.met) take_lead(path_of_met(run, task, family), true);
  for (const std::string& family : report.met_once) take_lead(path_of_met(run, task, family), false);
}

void Settling::take_lead(const std::string& path, bool confirmed) {
  if (confirmed && config_.shard.count == 1) file(path);
  if (confirmed) return;
  add_once(state_.unconfirmed, path);
  Result<Lead> read = read_lead(path);
  if (!read || is_unsteady(*read)) return;
  Lead lead = std::move(read).value();
  lead.original.provenance.shrink_stopped = kUnsteady;
  keep(lead);
}

void Settling::file(const std::string& path) {
  const Result<Lead> lead = read_lead(path);
  if (!lead) return fail(lead.issue());
  const Result<Corpus::Added> added = file_lead(corpus_, *lead);
  if (!added) return fail(added.issue());
  const std::string name = std::filesystem::path(added->bucket).filename();
  if (std::ranges::find(state_.new_buckets, name) != state_.new_buckets.end()) return;
  add_once(added->is_new ? state_.new_buckets : state_.known_buckets, name);
}

void Settling::keep(const Lead& lead) {
  if (const Result<std::string> kept = keep_lead(corpus_, lead); !kept) fail(kept.issue());
}

// A failure that was seen once and did not come again. Whoever looks for it begins with its spec.
void Settling::keep_unsteady(const Case& seen, const CaseTask& task) {
  Lead lead{state_.record.name, seen, {}};
  lead.original.provenance = provenance_in(config_, task.lineage.back());
  lead.original.provenance.rank = task.rank;
  lead.original.provenance.shrink_stopped = kUnsteady;
  keep(lead);
}

void Settling::keep_ending_of_once(const Case& ended, const CaseTask& task) {
  keep_unsteady(ended, task);
  add_once(state_.unconfirmed, lead_path(corpus_, state_.record.name, family_of(ended), task.lineage.back()));
}

std::vector<std::string> Settling::waiting() const {
  std::vector<std::string> paths = kept_;
  for (const CaseTask& task : waiting_) paths.push_back(task.lead);
  return paths;
}

std::string Settling::path_of_lead(const CaseTask& task) const {
  return lead_path(corpus_, state_.record.name, task.family, task.lineage.back());
}

std::string Settling::path_of_met(const std::string& run, const CaseTask& task, const std::string& family) const {
  return lead_path(corpus_, run, family, task.lineage.back(), task.family);
}

void Settling::fail(const Issue& issue) {
  if (issue_.code.empty()) issue_ = issue;
}

}  // namespace contort
