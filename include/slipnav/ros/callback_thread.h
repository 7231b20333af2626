#pragma once
/// A thread that serves the callbacks of one or several nodelets.
///
/// The threads of nodelet's manager would be woken twice for each callback, once to hand it out and once to run it. At
/// some hundred callbacks a second that costs more than all the computing.

#include <ros/callback_queue.h>

#include <memory>
#include <string>
#include <thread>

namespace slipnav {

/// That of the nodelets between which every IMU sample goes back and forth. Those that compute for long, or that the
/// operator's commands pass through, have their own.
inline constexpr const char* kNavigationThread = "navigation";

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

 private:
  ros::CallbackQueue queue_;
  std::thread thread_;
};

}  // namespace slipnav
