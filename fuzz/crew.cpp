#include "fuzz/crew.h"

#include <algorithm>
#include <utility>

namespace contort {

namespace {

constexpr double kSettlingPatience = 4.0;  // a failure may first run to its time limit in a process of its own

}  // namespace

Crew::Crew(int workers, const WorkerLimits& limits, WorkerPool::Work work)
    : pool_(workers, limits, std::move(work)), in_hand_(static_cast<std::size_t>(workers)) {}

bool Crew::is_any_case_running() const {
  return std::ranges::any_of(in_hand_, [](const std::optional<Job>& job) {
    return job && std::holds_alternative<PlacedCase>(*job);
  });
}

void Crew::give(const Job& job) {
  const int worker = pool_.idle_worker().value();
  if (const auto* failure = std::get_if<FailureJob>(&job))
    pool_.give(worker, print_task(task_of(*failure)), kSettlingPatience);
  else
    pool_.give(worker, print_task(std::get<PlacedCase>(job).task));
  in_hand_[static_cast<std::size_t>(worker)] = job;
}

std::optional<Crew::Finished> Crew::wait(int milliseconds) {
  const std::optional<WorkerEvent> event = pool_.wait(milliseconds);
  if (!event) return std::nullopt;
  std::optional<Job>& in_hand = in_hand_[static_cast<std::size_t>(event->worker)];
  const Finished finished{in_hand.value(), *event};
  in_hand.reset();
  return finished;
}

}  // namespace contort
