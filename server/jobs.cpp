#include "server/jobs.h"

#include <algorithm>

#include "model/core/json_fields.h"

namespace contort::server {

namespace {

using json_fields::Json;

constexpr std::size_t kRemembered = 100;
constexpr std::string_view kStates[] = {"queued", "running", "done", "failed"};

}  // namespace

std::string print_job(const Job& job) {
  const double seconds = job.state == JobState::running ? seconds_since(job.since) : job.seconds;
  const Result<Json> result = job.result.empty() ? Result<Json>(Json()) : json_fields::parse_document(job.result);
  const Json json = {{"job", job.id},
                     {"kind", job.kind},
                     {"bucket", job.about},
                     {"state", std::string(kStates[static_cast<std::size_t>(job.state)])},
                     {"seconds", on_lattice(seconds, 100)},
                     {"cpu_s", on_lattice(job.cpu_s, 100)},
                     {"text", job.text},
                     {"result", result ? *result : Json()}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Jobs::Jobs(int most_waiting, std::function<void(const Job&)> changed)
    : most_waiting_(most_waiting), changed_(std::move(changed)), thread_([this] { run(); }) {}

Jobs::~Jobs() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

Result<std::string> Jobs::add(const std::string& kind, const std::string& about, const std::string& client, Work work) {
  Job job;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, other] : jobs_)
      if (other.state == JobState::queued && other.kind == kind && other.about == about) return id;
    if (static_cast<int>(queue_.size()) >= most_waiting_)
      return Issue{"full.jobs", "", "the greatest number of jobs is waiting; try again later"};
    job.id = std::to_string(next_++), job.kind = kind, job.about = about, job.client = client;
    jobs_[job.id] = job;
    queue_.emplace_back(job.id, std::move(work));
  }
  wake_.notify_all();
  changed_(job);
  return job.id;
}

Result<Job> Jobs::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(id);
  if (found != jobs_.end()) return found->second;
  return Issue{"job.not_found", "", "there is no such job, or it ended long ago"};
}

int Jobs::waiting() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(queue_.size());
}

void Jobs::update(const std::string& id, const std::function<void(Job&)>& change) {
  Job now;
  {
    const std::lock_guard lock(mutex_);
    Job& job = jobs_[id];
    change(job);
    now = job;
    if (job.state == JobState::done || job.state == JobState::failed) ended_.push_back(id);
    if (ended_.size() > kRemembered) jobs_.erase(ended_.front()), ended_.pop_front();
  }
  changed_(now);
}

void Jobs::run() {
  const auto stop = [this] {
    const std::lock_guard lock(mutex_);
    return stop_;
  };
  for (;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return stop_ || !queue_.empty(); });
    if (stop_) return;
    const auto [id, work] = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    const Time since = std::chrono::steady_clock::now();
    update(id, [&](Job& job) { job.state = JobState::running, job.since = since; });
    Running running{stop};
    const Result<Outcome> outcome = work(running);
    update(id, [&](Job& job) {
      job.state = outcome ? JobState::done : JobState::failed;
      job.seconds = seconds_since(since), job.cpu_s = running.cpu_s;
      job.text = outcome ? outcome->text : to_line(outcome.issue());
      if (outcome) job.result = outcome->result;
    });
  }
}

}  // namespace contort::server
