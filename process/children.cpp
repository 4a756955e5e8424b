#include "process/children.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <new>
#include <span>
#include <stdexcept>

namespace contort {

namespace {

constexpr useconds_t kLook_us = 50'000;

// The state of a child's share of calls, in shared memory.
struct Place {
  std::atomic<int> at{0};    // index of the present call
  std::atomic<int> done{0};  // calls that returned
};

class Places {
 public:
  explicit Places(int count) : bytes_(sizeof(Place) * static_cast<std::size_t>(count)) {
    memory_ = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::runtime_error("no memory that processes share");
    for (int i = 0; i < count; ++i) new (static_cast<Place*>(memory_) + i) Place();
  }
  ~Places() { ::munmap(memory_, bytes_); }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;
  Place& operator[](int i) { return static_cast<Place*>(memory_)[i]; }

 private:
  std::size_t bytes_;
  void* memory_;
};

[[noreturn]] void run_share(Place& place, int first, int step, int count, int seconds,
                            const std::function<void(int)>& work, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent died before that call
  try {
    for (int i = first; i < count; i += step) {
      place.at = i;
      ::alarm(static_cast<unsigned>(seconds));
      work(i);
      ++place.done;
    }
    ::_exit(0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contort: internal error: %s\n", error.what());
  }
  ::_exit(1);
}

}  // namespace

std::vector<int> in_children(int jobs, int count, int seconds, const std::function<void(int)>& work,
                             const std::function<void(int done)>& idle) {
  Places places(jobs);
  std::vector<pid_t> children(static_cast<std::size_t>(jobs), 0);
  const pid_t parent = ::getpid();
  const auto start = [&](int share, int first) {
    const pid_t child = first < count ? ::fork() : 0;
    if (child < 0) throw std::runtime_error("cannot start a process");
    if (first < count && child == 0) run_share(places[share], first, jobs, count, seconds, work, parent);
    children[static_cast<std::size_t>(share)] = child;
  };
  for (int share = 0; share < jobs; ++share) start(share, share);
  std::vector<int> lost;
  while (std::ranges::any_of(children, [](pid_t child) { return child != 0; })) {
    int done = static_cast<int>(lost.size());
    for (int share = 0; share < jobs; ++share) {
      pid_t& child = children[static_cast<std::size_t>(share)];
      int status = 0;
      done += places[share].done;
      if (child == 0 || ::waitpid(child, &status, WNOHANG) != child) continue;
      child = 0;
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
      lost.push_back(places[share].at);
      start(share, places[share].at + jobs);
    }
    idle(done);
    ::usleep(kLook_us);
  }
  std::ranges::sort(lost);
  return lost;
}

}  // namespace contort
