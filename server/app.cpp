#include "server/app.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "model/core/files.h"
#include "model/core/hash.h"
#include "server/routes.h"

namespace contort::server {

namespace {

constexpr std::size_t kJobsTold = 100;
constexpr auto kPatience = std::chrono::seconds(1);

// A refusal asks the client to wait for one second. This sets a longer time for a client without CPU time.
void wait_for_cpu(Answer& answer, double wait_s) {
  for (auto& [name, value] : answer.headers)
    if (name == "Retry-After" && wait_s > 1.0) value = std::to_string(static_cast<int>(std::ceil(wait_s)));
}

Answer broken(const std::exception& error) {
  std::fprintf(stderr, "contort: internal error: %s\n", error.what());
  return refusal({"file.internal", "", "an internal error; the server's log has more"});
}

}  // namespace

// ---- news

void News::corpus(const std::string& revision) {
  {
    const std::lock_guard lock(mutex_);
    if (revision == revision_) return;
    revision_ = revision;
    ++corpus_;
  }
  changed_.notify_all();
}

void News::report() {
  {
    const std::lock_guard lock(mutex_);
    ++report_;
  }
  changed_.notify_all();
}

void News::job(const Job& job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.emplace_back(++job_, print_job(job));
    if (jobs_.size() > kJobsTold) jobs_.erase(jobs_.begin());
  }
  changed_.notify_all();
}

void News::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

std::vector<Event> News::since(Seen& seen) {
  std::unique_lock lock(mutex_);
  const bool first = seen.job < 0;
  const auto is_new = [&] { return closed_ || seen.corpus != corpus_ || seen.report != report_ || seen.job != job_; };
  changed_.wait_for(lock, kPatience, is_new);
  std::vector<Event> events;
  if (seen.corpus != corpus_) events.push_back({"corpus", "{\"revision\":\"" + revision_ + "\"}"});
  if (seen.report != report_) events.push_back({"report", "{\"revision\":" + std::to_string(report_) + "}"});
  for (const auto& [number, text] : jobs_)
    if (!first && number > seen.job) events.push_back({"job", text});
  seen = {corpus_, report_, job_};
  return events;
}

std::string News::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

bool News::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

// ---- the app

App::App(AppConfig config, Engine& engine)
    : config_(std::move(config)),
      engine_(engine),
      calls_left_(engine.limits().calls_per_s, engine.limits().calls_at_once),
      sessions_(engine),
      jobs_(engine.limits().jobs, [this](const Job& job) { tell(job); }) {
  if (!config_.corpus.empty()) triage_.emplace(config_.corpus, config_.program, config_.scratch);
}

App::~App() { close(); }

Answer App::answer(const Request& request) {
  if (std::optional<Answer> refused = refuse(request)) return std::move(*refused);
  return perform(request);
}

std::optional<Answer> App::refuse(const Request& head) {
  ++calls_;
  try {
    std::optional<Answer> refused = refuse_head(head);
    if (!refused) return std::nullopt;
    return counted(std::move(*refused), head.client);
  } catch (const std::exception& error) {
    return counted(broken(error), head.client);
  }
}

Answer App::perform(const Request& request) {
  try {
    return counted(dispatch(*this, request), request.client);
  } catch (const std::exception& error) {
    return counted(broken(error), request.client);
  }
}

std::optional<Answer> App::refuse_head(const Request& head) {
  if (const Result<Done> admitted = admit(head, config_.guard); !admitted) return refusal(admitted.issue());
  if (head.path.starts_with("/api") && !calls_left_.take(head.client, 1.0, now()))
    return refusal({"limit.calls", "", "too many calls in a short time"});
  if (closed_) return refusal({"full.closing", "", "the server ends"});
  const std::string length = head.header("content-length");
  return refuse_route(*this, head, std::strtoull(length.c_str(), nullptr, 10));
}

Answer App::counted(Answer answer, const std::string& client) {
  if (answer.status == 429) wait_for_cpu(answer, engine_.wait_s(client));
  if (answer.status >= 500 && answer.status != 503) ++failed_;
  if (answer.status >= 400) ++refused_;
  return answer;
}

void App::tell(const Job& job) {
  if (job.state == JobState::done || job.state == JobState::failed) {
    if (!job.client.empty()) engine_.spend(job.client, job.cpu_s);
    job_cpu_us_ += static_cast<std::int64_t>(1e6 * job.cpu_s);
  }
  news_.job(job);
}

void App::tick() {
  sessions_.sweep(now());
  if (!triage_) return;
  const std::string before = news_.revision(), revision = triage_->revision();
  if (before == revision) return;
  news_.corpus(revision);
  if (config_.report.empty()) return;
  if (const Result<std::string> job = make_report(); !job)
    std::fprintf(stderr, "contort: %s\n", to_line(job.issue()).c_str());
}

void App::close() {
  closed_ = true;
  news_.close();
  sessions_.close_all();
}

Result<const Triage*> App::corpus() const {
  if (!triage_) return Issue{"corpus.none", "", "this server has no corpus; start it with --corpus DIR"};
  return &*triage_;
}

Result<const Triage*> App::writable_corpus() const {
  if (config_.read_only) return Issue{"guard.read_only", "", "this server is read-only"};
  return corpus();
}

Result<std::string> App::make_report() {
  if (!triage_ || config_.report.empty()) return Issue{"corpus.none", "", "this server has no corpus to report"};
  const Jobs::Work work = triage_->report_work(config_.report);
  return jobs_.add("report", "", "", [this, work](Jobs::Running& running) {
    Result<Jobs::Outcome> outcome = work(running);
    if (outcome) news_.report();
    return outcome;
  });
}

Result<std::string> App::library_folder(const std::string& id) const {
  if (id.empty()) return std::string();
  const std::lock_guard lock(libraries_mutex_);
  const auto found = libraries_.find(id);
  if (found != libraries_.end()) return found->second;
  return Issue{"library.not_found", "/library", "no library was registered under that id"};
}

// The id is a hash of the contents, so registering the same library twice gives the same id.
Result<std::string> App::register_library(const std::map<std::string, std::string>& files) {
  std::string all;
  for (const auto& [name, text] : files) all += text + "\n";
  const std::string id = content_id(all).substr(0, 24);
  const std::string folder = config_.scratch + "/" + id;
  const std::lock_guard lock(libraries_mutex_);
  if (libraries_.contains(id)) return id;
  if (libraries_.size() >= 64) return Issue{"full.libraries", "", "the greatest number of libraries is registered"};
  if (const Result<Done> made = make_folder(folder); !made) return made.issue();
  int number = 0;
  for (const auto& [name, text] : files)
    if (const Result<Done> written = write_file(folder + "/" + std::to_string(number++) + ".json", text); !written)
      return written.issue();
  libraries_[id] = folder;
  return id;
}

Issue App::forget_library(const std::string& id, Issue why) {
  const std::lock_guard lock(libraries_mutex_);
  const std::string folder = libraries_[id];
  libraries_.erase(id);
  // Removes the folder from the message: the client does not know it, and may not learn it.
  if (const std::size_t at = why.text.find(folder); !folder.empty() && at != std::string::npos)
    why.text.erase(at, folder.size() + 1);
  return why;
}

Answer App::stream(const std::string& client, std::function<std::vector<Event>(bool& more)> next) {
  const Result<std::shared_ptr<void>> counted = sessions_.count_stream(client);
  if (!counted) return refusal(counted.issue());
  Answer answer;
  answer.type = "text/event-stream";
  answer.headers.emplace_back("Cache-Control", "no-store");
  answer.pieces = [this, held = *counted, next](bool& more) {
    std::string text;
    try {
      for (const Event& event : next(more)) text += print_event(event);
    } catch (const std::exception& error) {  // the page opens another stream; other streams must not end
      std::fprintf(stderr, "contort: internal error: %s\n", error.what());
      ++failed_, more = false;
    }
    if (closed_) more = false;
    return text;
  };
  return answer;
}

std::string App::metrics() const {
  const BrokerLoad load = engine_.load();
  const auto line = [](const char* name, const char* type, double value) {
    char text[200];
    std::snprintf(text, sizeof text, "# TYPE contort_%s %s\ncontort_%s %.10g\n", name, type, name, value);
    return std::string(text);
  };
  return line("calls_total", "counter", static_cast<double>(calls_)) +
         line("calls_refused_total", "counter", static_cast<double>(refused_)) +
         line("calls_failed_total", "counter", static_cast<double>(failed_)) +
         line("sessions", "gauge", sessions_.count()) + line("streams", "gauge", sessions_.streams()) +
         line("session_bytes", "gauge", static_cast<double>(sessions_.bytes())) +
         line("session_cpu_seconds_total", "counter", sessions_.cpu_s()) +
         line("tasks_waiting", "gauge", load.waiting) + line("tasks_running", "gauge", load.running) +
         line("tasks_done_total", "counter", static_cast<double>(load.done)) +
         line("tasks_ended_badly_total", "counter", static_cast<double>(load.ended_badly)) +
         line("task_seconds_total", "counter", load.worker_s) + line("jobs_waiting", "gauge", jobs_.waiting()) +
         line("job_cpu_seconds_total", "counter", 1e-6 * static_cast<double>(job_cpu_us_));
}

}  // namespace contort::server
