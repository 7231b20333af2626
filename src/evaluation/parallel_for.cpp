#include "evaluation/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace slipnav {

void parallelFor(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto takeTurns = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        failure = failure ? failure : std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < std::min(threads, count); ++i) {
    others.emplace_back(takeTurns);
  }
  takeTurns();
  for (std::thread& other : others) {
    other.join();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

std::size_t coreCount() { return std::max(1U, std::thread::hardware_concurrency()); }

void Cores::run(const std::function<void()>& work) {
  acquire();
  try {
    work();
  } catch (...) {
    release();
    throw;
  }
  release();
}

void Cores::acquire() {
  std::unique_lock<std::mutex> lock(mutex_);
  freed_.wait(lock, [this] { return free_ > 0; });
  --free_;
}

void Cores::release() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++free_;
  freed_.notify_one();
}

}  // namespace slipnav
