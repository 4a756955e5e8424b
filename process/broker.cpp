#include "process/broker.h"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <deque>
#include <system_error>
#include <vector>

#include "process/whole_bytes.h"

namespace contort {

namespace {

constexpr int kLook_ms = 50;  // time between two checks of the workers' limits
const Issue kGone{"work.gone", "", "the worker processes have ended"};

// A message between front and broker: this header, then as many bytes of text.
struct Header {
  std::uint64_t id = 0;
  std::uint64_t length = 0;
  std::uint64_t kind = 0;  // to the broker an Urgency; from it a WorkerEnd
  double worker_s = 0.0;   // time of the worker, sent by the broker
};

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool send_message(int socket, Header header, const std::string& text) {
  header.length = text.size();
  return send_all(socket, &header, sizeof header) && send_all(socket, text.data(), text.size());
}

bool receive_message(int socket, Header& header, std::string& text) {
  if (!receive_all(socket, &header, sizeof header)) return false;
  text.resize(header.length);
  return receive_all(socket, text.data(), text.size());
}

// The process of the broker. It takes tasks from the front and gives them to idle workers, urgent ones first.
class BrokerProcess {
 public:
  BrokerProcess(int socket, const BrokerLimits& limits, WorkerPool::Work work)
      : socket_(socket),
        pool_(limits.workers, limits.each, std::move(work)),
        given_(static_cast<std::size_t>(limits.workers)) {}

  // Runs until the front closes the connection.
  void run() {
    while (take_tasks()) {
      give_out();
      if (const std::optional<WorkerEvent> event = pool_.wait(pool_.busy() > 0 ? kLook_ms : -1, socket_))
        if (!tell(*event)) return;
    }
  }

 private:
  struct Queued {
    std::uint64_t id;
    std::string task;
  };
  struct Given {
    std::uint64_t id = 0;
    double since_s = 0.0;
  };

  bool take_tasks() {
    for (;;) {
      pollfd front{socket_, POLLIN, 0};
      if (::poll(&front, 1, 0) <= 0) return true;
      Header header;
      std::string text;
      if (!receive_message(socket_, header, text)) return false;
      queues_[header.kind == 0 ? 0 : 1].push_back({header.id, std::move(text)});
    }
  }

  void give_out() {
    for (std::deque<Queued>& queue : queues_)
      while (!queue.empty()) {
        const std::optional<int> worker = pool_.idle_worker();
        if (!worker) return;
        given_[static_cast<std::size_t>(*worker)] = {queue.front().id, now_s()};
        pool_.give(*worker, queue.front().task);
        queue.pop_front();
      }
  }

  bool tell(const WorkerEvent& event) {
    const Given& given = given_[static_cast<std::size_t>(event.worker)];
    return send_message(socket_, {given.id, 0, static_cast<std::uint64_t>(event.end), now_s() - given.since_s},
                        event.text);
  }

  int socket_;
  WorkerPool pool_;
  std::vector<Given> given_;      // by worker
  std::deque<Queued> queues_[2];  // by urgency
};

Result<std::string> result_of(WorkerEnd end, std::string text) {
  switch (end) {
    case WorkerEnd::replied: return text;
    case WorkerEnd::crashed:
      return Issue{"work.crash", "", "this spec ended the generator (" + text + "); nothing else is affected"};
    case WorkerEnd::timed_out: return Issue{"work.timeout", "", "this took longer than a task may"};
    case WorkerEnd::out_of_memory: break;
  }
  return Issue{"work.memory", "", "this took more memory than a task may"};
}

}  // namespace

Broker::Broker(const BrokerLimits& limits, WorkerPool::Work work) : limits_(limits) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "no socket for the broker");
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "no process for the broker");
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);
    ::close(ends[0]);
    ::signal(SIGINT, SIG_IGN);  // the front decides when to end
    ::signal(SIGTERM, SIG_IGN);
    BrokerProcess(ends[1], limits, std::move(work)).run();
    ::_exit(0);
  }
  ::close(ends[1]);
  socket_ = ends[0];
  reader_ = std::thread([this] { read_replies(); });
}

Broker::~Broker() {
  ::shutdown(socket_, SHUT_RDWR);
  reader_.join();
  ::close(socket_);
  ::kill(pid_, SIGKILL);  // its workers end with it
  ::waitpid(pid_, nullptr, 0);
}

BrokerReply Broker::run(const std::string& task, Urgency urgency) {
  Waiting mine;
  std::unique_lock lock(mutex_);
  if (gone_) return {kGone};
  if (static_cast<int>(waiting_.size()) >= limits_.workers + limits_.most_waiting)
    return {Issue{"work.busy", "", "too much is waiting to be generated"}};
  const std::uint64_t id = next_id_++;
  waiting_[id] = &mine;
  lock.unlock();
  {
    const std::lock_guard sending(sending_);
    if (!send_message(socket_, {id, 0, static_cast<std::uint64_t>(urgency), 0.0}, task)) finish(id, {kGone});
  }
  lock.lock();
  changed_.wait(lock, [&] { return mine.done; });
  return std::move(mine.reply);
}

BrokerLoad Broker::load() const {
  const std::lock_guard lock(mutex_);
  BrokerLoad load = load_;
  const int all = static_cast<int>(waiting_.size());
  load.running = std::min(all, limits_.workers);
  load.waiting = all - load.running;
  return load;
}

void Broker::finish(std::uint64_t id, BrokerReply reply) {
  const std::lock_guard lock(mutex_);
  const auto found = waiting_.find(id);
  if (found == waiting_.end()) return;
  found->second->reply = std::move(reply);
  found->second->done = true;
  waiting_.erase(found);
  changed_.notify_all();
}

void Broker::read_replies() {
  Header header;
  std::string text;
  while (receive_message(socket_, header, text)) {
    const auto end = static_cast<WorkerEnd>(header.kind);
    {
      const std::lock_guard lock(mutex_);
      ++(end == WorkerEnd::replied ? load_.done : load_.ended_badly);
      load_.worker_s += header.worker_s;
    }
    finish(header.id, {result_of(end, std::move(text)), header.worker_s});
  }
  const std::lock_guard lock(mutex_);
  gone_ = true;
  for (const auto& [id, waiting] : waiting_) {
    waiting->reply = {kGone};
    waiting->done = true;
  }
  waiting_.clear();
  changed_.notify_all();
}

}  // namespace contort
