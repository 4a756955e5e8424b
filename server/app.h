// The server without its sockets: a request in, an answer out. server/routes.h has the table of calls.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/allowance.h"
#include "server/guard.h"
#include "server/jobs.h"
#include "server/request.h"
#include "server/sessions.h"
#include "server/triage.h"

namespace contort::server {

struct AppConfig {
  GuardConfig guard;
  bool read_only = false;              // the corpus does not change
  std::string corpus;                  // folder; "": none
  std::string report;                  // folder of the page that is made of it
  std::string pages;                   // folder of play.html and what it loads
  std::string scratch;                 // folder for registered libraries and for files that pass
  std::string catalogue;               // JSON: what there is; docs/server.md
  std::vector<std::string> program;    // how contort is called
  std::function<std::string()> today;  // for what gates
};

// News for everybody who listens, as counters: a listener compares them with those that it saw last.
class News {
 public:
  struct Seen {
    std::int64_t corpus = -1, report = -1, job = -1;
  };
  void corpus(const std::string& revision);  // tells nothing where it is the same
  void report();
  void job(const Job& job);
  void close();

  // Waits for up to a second.
  std::vector<Event> since(Seen& seen);
  std::string revision() const;
  bool closed() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::string revision_;
  std::int64_t corpus_ = 0, report_ = 0, job_ = 0;
  std::vector<std::pair<std::int64_t, std::string>> jobs_;  // the latest
  bool closed_ = false;
};

class App {
 public:
  App(AppConfig config, Engine& engine);
  ~App();

  // Everything from the guard to the answer. Never throws, nor do the two that it is made of.
  Answer answer(const Request& request);
  // Looks at a request of which the body has not been read: why it need not be, or nothing where it may go on.
  std::optional<Answer> refuse(const Request& head);
  // Answers a request that was not refused.
  Answer perform(const Request& request);

  // Once a second or so: idle sessions end, and what others did to the corpus is told and reported.
  void tick();
  // Streams end, new calls are refused; what runs is finished by the caller's threads.
  void close();
  bool closed() const { return closed_; }

  // For handlers.
  const AppConfig& config() const { return config_; }
  Engine& engine() { return engine_; }
  const Limits& limits() const { return engine_.limits(); }
  Sessions& sessions() { return sessions_; }
  Jobs& jobs() { return jobs_; }
  News& news() { return news_; }
  // Code corpus.none without one; guard.read_only.
  Result<const Triage*> corpus() const;
  Result<const Triage*> writable_corpus() const;
  Result<std::string> library_folder(const std::string& id) const;  // code library.not_found; "" for ""
  Result<std::string> register_library(const std::map<std::string, std::string>& files);
  Issue forget_library(const std::string& id, Issue why);  // what turned out not to fit; `why`, about the body
  Result<std::string> make_report();                       // the job
  std::string metrics() const;
  // A stream for one client; see Sessions::count_stream.
  Answer stream(const std::string& client, std::function<std::vector<Event>(bool& more)> next);

 private:
  void tell(const Job& job);
  std::optional<Answer> refuse_head(const Request& head);
  Answer counted(Answer answer, const std::string& client);

  AppConfig config_;
  Engine& engine_;
  std::atomic<bool> closed_ = false;
  std::atomic<std::int64_t> calls_ = 0, refused_ = 0, failed_ = 0, job_cpu_us_ = 0;
  Allowance calls_left_;
  std::optional<Triage> triage_;
  News news_;
  Sessions sessions_;
  Jobs jobs_;
  mutable std::mutex libraries_mutex_;
  std::map<std::string, std::string> libraries_;  // id to folder
};

}  // namespace contort::server
