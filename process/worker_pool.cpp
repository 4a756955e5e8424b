#include "process/worker_pool.h"

#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

#include "model/core/assert.h"
#include "process/clock.h"
#include "process/ended.h"
#include "process/kernel.h"
#include "process/whole_bytes.h"

namespace contort {

namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

constexpr double kLookEvery_s = 0.05;  // time between two checks of limits, each of which reads a file of /proc

// A message is a length, followed by that many bytes.
using Length = std::uint64_t;

bool send_message(int socket, const std::string& text) {
  const Length length = text.size();
  char head[sizeof length];
  std::memcpy(head, &length, sizeof length);
  return send_all(socket, head, sizeof head) && send_all(socket, text.data(), text.size());
}

bool receive_message(int socket, std::string& text) {
  Length length = 0;
  char head[sizeof length];
  if (!receive_all(socket, head, sizeof head)) return false;
  std::memcpy(&length, head, sizeof length);
  text.resize(length);
  return receive_all(socket, text.data(), length);
}

// Takes the first complete message from the received bytes.
std::optional<std::string> take_message(std::string& received) {
  Length length = 0;
  if (received.size() < sizeof length) return std::nullopt;
  std::memcpy(&length, received.data(), sizeof length);
  if (received.size() - sizeof length < length) return std::nullopt;
  std::string text = received.substr(sizeof length, length);
  received.erase(0, sizeof length + length);
  return text;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return signal_name(WTERMSIG(status));
  return "exit " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

Ending ending_of(const WorkerEvent& event) {
  CONTORT_ASSERT(event.end != WorkerEnd::replied);
  switch (event.end) {
    case WorkerEnd::timed_out: return {Ending::Kind::timeout, {}, {}, event.printed};
    case WorkerEnd::out_of_memory: return {Ending::Kind::memory, {}, {}, event.printed};
    default: return {Ending::Kind::crash, event.text, {}, event.printed};
  }
}

Isolation isolation_of(const WorkerLimits& limits) {
  return {std::max(1, static_cast<int>(std::ceil(limits.seconds))), limits.bytes, true};
}

void WorkerSlot::note(std::string_view text) {
  length_ = 0;
  if (!text.empty() && text.size() <= kMostNote) std::memcpy(text_, text.data(), text.size());
  std::atomic_signal_fence(std::memory_order_seq_cst);
  if (text.size() <= kMostNote) length_ = text.size();
}

void WorkerSlot::end(std::string_view ending) {
  ending_length_ = std::min(ending.size(), sizeof ending_);
  if (ending_length_ > 0) std::memcpy(ending_, ending.data(), ending_length_);
}

WorkerPool::WorkerPool(int workers, const WorkerLimits& limits, Work work)
    : limits_(limits), work_(std::move(work)), workers_(static_cast<std::size_t>(workers)) {
  for (Worker& worker : workers_) {
    void* memory = ::mmap(nullptr, sizeof(WorkerSlot), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) fail("no memory for a worker");
    worker.slot = new (memory) WorkerSlot;
    start(worker);
  }
}

WorkerPool::~WorkerPool() {
  for (Worker& worker : workers_) {
    ::kill(worker.pid, SIGKILL);
    ::waitpid(worker.pid, nullptr, 0);
    ::close(worker.socket);
    ::munmap(worker.slot, sizeof(WorkerSlot));
  }
}

void WorkerPool::start(Worker& worker) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail("no socket for a worker");
  std::fflush(nullptr);  // otherwise the child would print the buffered text again
  const pid_t parent = ::getpid();
  worker.pid = ::fork();
  if (worker.pid < 0) fail("no process for a worker");
  if (worker.pid == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);  // the parent died before that call
    for (const Worker& other : workers_)
      if (other.socket >= 0) ::close(other.socket);
    ::close(ends[0]);
    serve(ends[1], *worker.slot);
  }
  ::close(ends[1]);
  worker.socket = ends[0];
  worker.busy = false;
  worker.received.clear();
}

// Runs in the child. Ctrl-C at the terminal goes to the whole group, and the pool reacts to it, so the child ignores
// it. noexcept: an exception ends the child by SIGABRT. If it unwound into the caller's copy of the stack, the pool's
// destructor would kill processes, even the whole process group.
void WorkerPool::serve(int socket, WorkerSlot& slot) noexcept {
  ::signal(SIGINT, SIG_IGN);
  ::signal(SIGTERM, SIG_DFL);
  std::string task;
  try {
    while (receive_message(socket, task))
      if (!send_message(socket, work_(task, slot))) break;
  } catch (const ProgramEnded& ended) {
    slot.end(print_ending(ended.ending()));
  }
  ::_exit(0);
}

std::optional<int> WorkerPool::idle_worker() const {
  for (std::size_t i = 0; i < workers_.size(); ++i)
    if (!workers_[i].busy) return static_cast<int>(i);
  return std::nullopt;
}

int WorkerPool::busy() const {
  return static_cast<int>(std::ranges::count_if(workers_, [](const Worker& worker) { return worker.busy; }));
}

void WorkerPool::give(int index, const std::string& task, double patience) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  CONTORT_ASSERT(!worker.busy);
  worker.slot->note({});
  worker.busy = true;
  worker.patience = patience;
  worker.beats = worker.slot->beats();
  worker.since_s = steady_s();
  send_message(worker.socket, task);  // if sending fails the worker has ended, and wait() will notice it
}

std::optional<WorkerEvent> WorkerPool::wait(int milliseconds, int other) {
  std::vector<pollfd> sockets;
  for (const Worker& worker : workers_) sockets.push_back({worker.socket, POLLIN, 0});
  sockets.push_back({other, POLLIN, 0});
  ::poll(sockets.data(), sockets.size(), milliseconds);
  for (std::size_t i = 0; i < workers_.size(); ++i)
    if (workers_[i].busy && sockets[i].revents != 0)
      if (std::optional<WorkerEvent> event = receive(static_cast<int>(i))) return event;
  if (steady_s() - looked_s_ < kLookEvery_s) return std::nullopt;
  looked_s_ = steady_s();
  for (std::size_t i = 0; i < workers_.size(); ++i)
    if (workers_[i].busy)
      if (std::optional<WorkerEvent> event = over_limit(static_cast<int>(i))) return event;
  return std::nullopt;
}

std::optional<WorkerEvent> WorkerPool::receive(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  char buffer[65536];
  const ssize_t got = ::recv(worker.socket, buffer, sizeof buffer, MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  if (got <= 0) return bury(index, WorkerEnd::crashed);
  worker.received.append(buffer, static_cast<std::size_t>(got));
  std::optional<std::string> reply = take_message(worker.received);
  if (!reply) return std::nullopt;
  worker.busy = false;
  return WorkerEvent{index, WorkerEnd::replied, std::move(*reply), {}};
}

std::optional<WorkerEvent> WorkerPool::over_limit(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  if (const std::uint64_t beats = worker.slot->beats(); beats != worker.beats) {
    worker.beats = beats;
    worker.since_s = steady_s();
  }
  if (steady_s() - worker.since_s > worker.patience * limits_.seconds) return bury(index, WorkerEnd::timed_out);
  if (resident_bytes(worker.pid) > limits_.bytes) return bury(index, WorkerEnd::out_of_memory);
  return std::nullopt;
}

// Ends the worker if it still runs, and starts another in its place.
WorkerEvent WorkerPool::bury(int index, WorkerEnd end) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  if (end != WorkerEnd::crashed) ::kill(worker.pid, SIGKILL);
  int status = 0;
  while (::waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
  }
  WorkerEvent event{index, end, end == WorkerEnd::crashed ? how_it_ended(status) : "", worker.slot->note()};
  if (const std::string ended = worker.slot->ended(); end == WorkerEnd::crashed && !ended.empty()) {
    const Ending ending = parse_ending(ended);
    event.end = ending.kind == Ending::Kind::timeout  ? WorkerEnd::timed_out
                : ending.kind == Ending::Kind::memory ? WorkerEnd::out_of_memory
                                                      : WorkerEnd::crashed;
    event.text = ending.signal, event.printed = ending.printed;
  }
  worker.slot->end({});
  ::close(worker.socket);
  worker.socket = -1;
  start(worker);
  return event;
}

}  // namespace contort
