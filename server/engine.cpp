#include "server/engine.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace contort::server {

namespace {

double cpu_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Runs in the worker. The result is the CPU time in microseconds, then the reply.
std::string work(Worker& worker, const std::string& text) {
  const double since_s = cpu_s();
  const Result<Task> task = parse_task(text);
  const Result<Reply> reply = task ? worker.run(*task) : Result<Reply>(task.issue());
  const std::string answer = print_reply(reply);
  return std::to_string(static_cast<long long>(1e6 * (cpu_s() - since_s))) + " " + answer;
}

Worked worked_of(const BrokerReply& reply) {
  if (!reply.text) return {reply.text.issue(), reply.worker_s};
  const std::string& answer = *reply.text;
  const std::size_t end = std::min(answer.find(' '), answer.size());
  return {parse_reply(end == answer.size() ? "" : answer.substr(end + 1)), 1e-6 * std::strtod(answer.c_str(), nullptr)};
}

WorkerPool::Work make_work(Generator& generator, const CheckSettings& settings, const std::string& tool) {
  auto worker = std::make_shared<Worker>(generator, settings, tool);
  return [worker](const std::string& task, WorkerSlot&) { return work(*worker, task); };
}

}  // namespace

Engine::Engine(const Limits& limits, const BrokerLimits& workers, Generator& generator, const CheckSettings& settings,
               const std::string& tool)
    : limits_(limits),
      cpu_left_(limits.cpu_s_per_minute / 60.0, limits.cpu_s_per_minute * limits.cpu_minutes_at_once),
      broker_(workers, make_work(generator, settings, tool)),
      thread_([this] { do_later(); }) {}

Engine::~Engine() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    waiting_.clear();
  }
  changed_.notify_all();
  thread_.join();
}

Worked Engine::run(const Task& task, const std::string& client, Urgency urgency) {
  if (const Result<Done> may = may_work(client); !may && urgency == Urgency::now) return {may.issue(), 0.0};
  Worked worked = worked_of(broker_.run(print_task(task), urgency));
  spend(client, worked.cpu_s);
  return worked;
}

Result<Done> Engine::may_work(const std::string& client) {
  const double wait = wait_s(client);
  if (wait <= 0.0) return Done{};
  return Issue{"limit.cpu", "",
               "this client has used all of its CPU time; more is available in " +
                   std::to_string(static_cast<int>(std::ceil(wait))) + " s"};
}

void Engine::spend(const std::string& client, double cpu_s) { cpu_left_.spend(client, cpu_s, now()); }

double Engine::wait_s(const std::string& client) { return cpu_left_.wait_s(client, now()); }

void Engine::later(const std::string& key, std::function<void()> work) {
  {
    const std::lock_guard lock(mutex_);
    const auto is_same = [&](const auto& other) { return other.first == key; };
    if (std::ranges::any_of(waiting_, is_same)) return;
    waiting_.emplace_back(key, std::move(work));
  }
  changed_.notify_one();
}

void Engine::do_later() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const auto next = std::move(waiting_.front().second);
    waiting_.pop_front();
    lock.unlock();
    next();
    lock.lock();
  }
}

}  // namespace contort::server
