#include "fuzz/failure_queue.h"

#include <algorithm>
#include <filesystem>

#include "corpus/ending_case.h"
#include "corpus/leads.h"
#include "fuzz/case_work.h"

namespace contort {

namespace {

void add_once(std::vector<std::string>& list, const std::string& name) {
  if (const auto at = std::ranges::lower_bound(list, name); at == list.end() || *at != name) list.insert(at, name);
}

bool is_among(const std::vector<Lead>& leads, const Lead& wanted) {
  return std::ranges::any_of(leads, [family = family_of(wanted.original)](const Lead& lead) {
    return family_of(lead.original) == family;
  });
}

}  // namespace

Case case_of_ending(const WorkerEvent& event, const Spec& given, const WorkerLimits& limits) {
  const Result<Spec> noted = parse_spec(event.note);
  return ending_case(noted ? *noted : given, ending_of(event), isolation_of(limits));
}

Task task_of(const FailureJob& job) {
  return std::visit([](const auto& one) { return Task(one.task); }, job);
}

void FailureQueue::go_on() {
  wanted_.clear();
  for (const SettleTask& task : state_.wanted) wanted_.push_back({task});
}

void FailureQueue::find_waiting() {
  std::vector<Issue> damaged;
  for (const Lead& lead : leads_of(corpus_, damaged))
    if (waits(lead))
      waiting_.push_back({{lead_path(corpus_, lead), false}, lead.run, lead.original.provenance.index});
}

void FailureQueue::want(const SettleTask& task) {
  state_.wanted.push_back(task);
  wanted_.push_back({task});
}

void FailureQueue::only_keep() {
  for (WantedFailure& job : wanted_) job.task.shrinks = false;
}

FailureQueue::CaseId FailureQueue::case_of(const FailureJob& job) const {
  if (const auto* waiting = std::get_if<WaitingLead>(&job)) return {waiting->run, waiting->index};
  return {state_.record.name, std::get<WantedFailure>(job).task.lineage.back()};
}

// Processes one failure of a case at a time: failures that its minimal spec also shows need not be shrunk.
std::optional<FailureJob> FailureQueue::next(bool with_waiting) {
  const auto is_free = [&](const WantedFailure& job) {
    return std::ranges::find(in_hand_, case_of(job)) == in_hand_.end();
  };
  std::optional<FailureJob> job;
  if (const auto at = std::ranges::find_if(wanted_, is_free); at != wanted_.end()) {
    job = std::move(*at);
    wanted_.erase(at);
  } else if (with_waiting && !waiting_.empty()) {
    job = std::move(waiting_.front());
    waiting_.pop_front();
  }
  if (job) in_hand_.push_back(case_of(*job));
  return job;
}

void FailureQueue::take(const FailureJob& job, const WorkerEvent& event) {
  in_hand_.erase(std::ranges::find(in_hand_, case_of(job)));
  if (const auto* waiting = std::get_if<WaitingLead>(&job)) return take_waiting(*waiting, event);
  take_wanted(std::get<WantedFailure>(job), event);
}

void FailureQueue::take_wanted(const WantedFailure& job, const WorkerEvent& event) {
  const SettleTask& task = job.task;
  if (event.end != WorkerEnd::replied && !task.guarded) return shrink_guarded(job, event);
  settle_no_more(task, {task.family});
  SettledLead settled;
  if (event.end == WorkerEnd::replied) {
    const SettleReport report = parse_report<SettleReport>(event.text);
    if (!report.issue.empty()) return fail({"file.unwritable", "", report.issue});
    settled = report.settled;
    if (settled.confirmed && !task.shrinks) return kept_.push_back(lead_path(corpus_, settled.lead));
    take_settled(settled);
    if (config_.shard.count == 1) settle_no_more(task, families_told_by(settled.lead));
  } else {
    keep_unsteady(lead_of(seen_once(task, spec_of(config_, generator_, task.lineage), generator_, config_.limits),
                          task.lineage, task.rank));
  }
  if (!job.ender || is_among(settled.incidental, *job.ender)) return;
  const auto& of_base = settled.incidental_of_base;
  if (std::ranges::find(of_base, family_of(job.ender->original)) != of_base.end())
    return drop_lead(corpus_, *job.ender);
  keep_unsteady(*job.ender);
}

// The lead may already be gone: another process, or this one, has filed it. A lead that ended its worker is tried once
// more with a guard.
void FailureQueue::take_waiting(WaitingLead job, const WorkerEvent& event) {
  if (event.end == WorkerEnd::replied) {
    const ShrinkReport report = parse_report<ShrinkReport>(event.text);
    if (!report.issue.empty()) return fail({"file.unwritable", "", report.issue});
    if (!report.shrunk) return;
    take_settled(*report.shrunk);
    return tidy_leads(corpus_, job.run);
  }
  Result<Lead> lead = read_lead(job.task.lead);
  if (!lead) return;
  if (job.task.guarded) return keep_unsteady(std::move(lead).value());
  job.task.guarded = true;
  waiting_.push_front(std::move(job));
}

// The worker has stored all these leads. With shards, `merge` files them.
void FailureQueue::take_settled(const SettledLead& settled) {
  const auto note = [&](const Lead& lead) { add_once(state_.unconfirmed, lead_path(corpus_, lead)); };
  settled.confirmed ? file(settled.lead) : note(settled.lead);
  for (const Lead& lead : settled.incidental) file(lead);
  for (const Lead& lead : settled.incidental_unconfirmed) note(lead);
}

// Removes failures that need no bucket of their own, because the minimal spec of their case shows them. In a shard
// `merge` does this, so a shard shrinks more than a whole run.
void FailureQueue::settle_no_more(const SettleTask& of_case, const std::set<Family>& families) {
  const auto is_settled = [&](const SettleTask& task) {
    return task.lineage == of_case.lineage && families.contains(task.family);
  };
  std::erase_if(state_.wanted, is_settled);
  std::erase_if(wanted_, [&](const WantedFailure& job) { return is_settled(job.task); });
}

// A candidate of the shrinking ended the process. This is a failure of its own and is stored at once. The guarded
// worker must find it again, otherwise it is not confirmed. The job stays before the later failures of its case.
void FailureQueue::shrink_guarded(WantedFailure job, const WorkerEvent& event) {
  const SettleTask& task = job.task;
  const Spec given = spec_of(config_, generator_, task.lineage);
  Lead lead = lead_of(case_of_ending(event, given, config_.limits), task.lineage, 0);
  lead.original.provenance.met_shrinking = task.family;
  keep(lead);
  job.task.guarded = true, job.ender = std::move(lead);
  wanted_.push_front(std::move(job));
}

void FailureQueue::file(const Lead& lead) {
  if (config_.shard.count > 1) return;
  const Result<Corpus::Added> added = file_lead(corpus_, lead);
  if (!added) return fail(added.issue());
  const std::string name = std::filesystem::path(added->bucket).filename();
  if (std::ranges::find(state_.new_buckets, name) != state_.new_buckets.end()) return;
  add_once(added->is_new ? state_.new_buckets : state_.known_buckets, name);
}

void FailureQueue::keep(const Lead& lead) {
  if (const Result<std::string> kept = keep_lead(corpus_, lead); !kept) fail(kept.issue());
}

// Stores a failure that showed once and not again, so that a person can start from its spec.
void FailureQueue::keep_unsteady(Lead lead) {
  lead.original.provenance.shrink_stopped = kUnsteady;
  keep(lead);
  add_once(state_.unconfirmed, lead_path(corpus_, lead));
}

// Makes a lead of a failing case of this run.
Lead FailureQueue::lead_of(const Case& seen, const Lineage& lineage, int rank) const {
  Lead lead{state_.record.name, seen, {}};
  lead.original.provenance = provenance_in(config_, lineage.back());
  lead.original.provenance.rank = rank;
  return lead;
}

void FailureQueue::keep_ending_of_once(const Case& ended, const Lineage& lineage) {
  keep_unsteady(lead_of(ended, lineage, 0));
}

std::vector<std::string> FailureQueue::waiting() const {
  std::vector<std::string> paths = kept_;
  for (const WaitingLead& job : waiting_) paths.push_back(job.task.lead);
  return paths;
}

void FailureQueue::fail(const Issue& issue) {
  if (issue_.code.empty()) issue_ = issue;
}

}  // namespace contort
