// The server without its sockets: it takes a request and returns an answer. server/routes.h has the table of calls.
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
  std::string corpus;                  // folder of the corpus; "": none
  std::string report;                  // folder of the report's pages
  std::string pages;                   // folder of play.html and the files that it loads
  std::string library;                 // the script library.js, if pages play specs themselves (docs/internals/wasm.md)
  std::string scratch;                 // folder for registered libraries and temporary files
  std::string catalogue;               // JSON: the catalogue of docs/reference/server.md
  std::vector<std::string> program;    // the command line of contort
  std::function<std::string()> today;  // the present day, for quarantines and waivers
};

// Counters of changes, for all listeners: a listener compares them with the values that it saw last.
class News {
 public:
  struct Seen {
    std::int64_t corpus = -1, report = -1, job = -1;
  };
  void corpus(const std::string& revision);  // does nothing if the revision is the same
  void report();
  void job(const Job& job);
  void close();

  // Returns the changes since `seen`; waits up to a second for one.
  std::vector<Event> since(Seen& seen);
  std::string revision() const;
  bool closed() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::string revision_;
  std::int64_t corpus_ = 0, report_ = 0, job_ = 0;
  std::vector<std::pair<std::int64_t, std::string>> jobs_;  // the latest jobs
  bool closed_ = false;
};

class App {
 public:
  App(AppConfig config, Engine& engine);
  ~App();

  // Handles a request completely, from the guard to the answer. Neither this nor the next two functions throw.
  Answer answer(const Request& request);
  // Checks a request before its body is read. Returns the refusal, or nothing if the request may continue.
  std::optional<Answer> refuse(const Request& head);
  // Answers a request that was not refused.
  Answer perform(const Request& request);

  // Call this about once a second. It ends idle sessions, and reports changes that other programs made to the corpus.
  void tick();
  // Ends streams and refuses new calls. The caller's threads finish the running calls.
  void close();
  bool closed() const { return closed_; }

  // The following functions are for handlers.
  const AppConfig& config() const { return config_; }
  Engine& engine() { return engine_; }
  const Limits& limits() const { return engine_.limits(); }
  Sessions& sessions() { return sessions_; }
  Jobs& jobs() { return jobs_; }
  News& news() { return news_; }
  // Return the corpus, the second one for a change. Codes corpus.none without a corpus, guard.read_only.
  Result<const Triage*> corpus() const;
  Result<const Triage*> writable_corpus() const;
  Result<std::string> library_folder(const std::string& id) const;  // code library.not_found; "" for ""
  Result<std::string> register_library(const std::map<std::string, std::string>& files);
  Issue forget_library(const std::string& id, Issue why);  // removes an unfit library; returns `why`
  Result<std::string> make_report();                       // runs the report job
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
  std::map<std::string, std::string> libraries_;  // folder of each library, by id
};

}  // namespace contort::server
