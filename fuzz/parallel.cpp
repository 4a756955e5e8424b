#include "fuzz/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace contort {

void parallel_for(int jobs, int count, const std::function<void(int, int)>& work, const std::function<void()>& idle) {
  std::atomic<int> next{0};
  std::mutex mutex;
  std::condition_variable finished;
  std::exception_ptr first_failure;
  int running = std::min(jobs, count);
  std::vector<std::thread> threads;
  for (int worker = 0; worker < std::min(jobs, count); ++worker)
    threads.emplace_back([&, worker] {
      std::exception_ptr failure;
      try {
        for (int index = next++; index < count; index = next++) work(worker, index);
      } catch (...) {
        failure = std::current_exception();
        next = count;
      }
      const std::lock_guard lock(mutex);
      if (failure && !first_failure) first_failure = failure;
      if (--running == 0) finished.notify_one();
    });
  {
    std::unique_lock lock(mutex);
    while (!finished.wait_for(lock, std::chrono::milliseconds(100), [&] { return running == 0; })) {
      lock.unlock();
      idle();
      lock.lock();
    }
  }
  for (std::thread& thread : threads) thread.join();
  if (first_failure) std::rethrow_exception(first_failure);
}

}  // namespace contort
