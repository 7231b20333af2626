#pragma once
/// Many independent runs on all cores.

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>

namespace slipnav {

/// Calls work(0) … work(count − 1), up to `threads` at a time, and returns when all have ended. The first exception is
/// rethrown; calls not started by then are skipped.
void parallelFor(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work);

/// Number of cores of this machine, at least one.
std::size_t coreCount();

/// Limits how many pieces of work run at the same time, whoever they belong to.
class Cores {
 public:
  explicit Cores(std::size_t count) : free_(count) {}
  /// Waits for a free core, and runs `work` on it.
  void run(const std::function<void()>& work);

 private:
  void acquire();
  void release();

  std::mutex mutex_;
  std::condition_variable freed_;
  std::size_t free_;
};

}  // namespace slipnav
