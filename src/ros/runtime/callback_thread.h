#pragma once
/// A thread that serves the callbacks of one or several nodelets, and their periodic work.
///
/// The threads of nodelet's manager would wake twice for each callback, once to dispatch it and once to run it. At
/// some hundred callbacks a second that costs more than all the computing. So would the timers of roscpp, which run on
/// a separate thread that only dispatches.

#include <ros/callback_queue.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace slipnav {

/// Shared by the nodelets between which every IMU sample goes back and forth. Those with long computations, and those
/// that pass on the operator's commands, have their own.
inline constexpr const char* kNavigationThread = "navigation";

/// Work that a CallbackThread repeats, until this is destroyed or assigned to: that waits for a running call, and so
/// must not be done by the work itself.
class RepeatedWork {
 public:
  RepeatedWork() = default;
  ~RepeatedWork() { end(); }
  RepeatedWork(const RepeatedWork&) = delete;
  RepeatedWork& operator=(const RepeatedWork&) = delete;
  RepeatedWork(RepeatedWork&&) = default;
  RepeatedWork& operator=(RepeatedWork&& other) noexcept;

 private:
  friend class CallbackThread;
  struct Task;
  explicit RepeatedWork(std::shared_ptr<Task> task) : task_(std::move(task)) {}
  void end();

  std::shared_ptr<Task> task_;
};

/// Serves its queue from construction to destruction.
class CallbackThread {
 public:
  CallbackThread();
  ~CallbackThread();
  CallbackThread(const CallbackThread&) = delete;
  CallbackThread& operator=(const CallbackThread&) = delete;

  /// The thread of this name in this process; it ends with its last user.
  static std::shared_ptr<CallbackThread> shared(const std::string& name);

  ros::CallbackQueue& queue() { return queue_; }

  /// Calls `work`, which must not throw, every `interval_s` [s] of real time; the first call may be up to a second
  /// late.
  RepeatedWork repeat(double interval_s, std::function<void()> work);

 private:
  void run();
  double secondsUntilWork();
  void doWork();

  ros::CallbackQueue queue_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<RepeatedWork::Task>> tasks_;
  std::thread thread_;  ///< last: it uses the others
};

}  // namespace slipnav
