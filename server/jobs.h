// Runs work that takes seconds or minutes, one job after another: reports, shrinking, replays.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "model/core/result.h"
#include "server/played.h"

namespace contort::server {

enum class JobState { queued, running, done, failed };

struct Job {
  std::string id;
  std::string kind;    // report, shrink, replay
  std::string about;   // id of a bucket; "" for jobs about the whole corpus
  std::string client;  // the client that asked for it; "": the server itself
  JobState state = JobState::queued;
  std::string text;    // a sentence for people
  std::string result;  // JSON; "" as long as there is no result
  Time since{};        // the time at which it began to run
  double seconds = 0.0;
  double cpu_s = 0.0;  // CPU time of the programs that it ran
};

// Prints a job as {job, kind, bucket, state, seconds, cpu_s, text, result}.
std::string print_job(const Job& job);

class Jobs {
 public:
  // The state of a running job. `stop` returns true if the job is no longer wanted; `cpu_s` is the CPU time that it has
  // used.
  struct Running {
    std::function<bool()> stop;
    double cpu_s = 0.0;
  };
  // The job's sentence and JSON, or the reason of its failure.
  struct Outcome {
    std::string text;
    std::string result;
  };
  using Work = std::function<Result<Outcome>(Running&)>;

  // At most `most_waiting` jobs may wait. `changed` is called from the jobs' thread.
  Jobs(int most_waiting, std::function<void(const Job&)> changed);
  ~Jobs();  // stops the running job

  // Adds a job and returns its id. If a job of the same kind for the same object still waits, its id is returned
  // instead. Code full.jobs.
  Result<std::string> add(const std::string& kind, const std::string& about, const std::string& client, Work work);
  // Finds a job. Code job.not_found; only the last hundred ended jobs are kept.
  Result<Job> find(const std::string& id) const;
  int waiting() const;

 private:
  void run();
  void update(const std::string& id, const std::function<void(Job&)>& change);

  int most_waiting_;
  std::function<void(const Job&)> changed_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::map<std::string, Job> jobs_;
  std::deque<std::pair<std::string, Work>> queue_;
  std::deque<std::string> ended_;
  std::int64_t next_ = 1;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace contort::server
