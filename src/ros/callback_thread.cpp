#include "slipnav/ros/callback_thread.h"

#include <map>
#include <mutex>

namespace slipnav {
namespace {

const ros::WallDuration kLongestSleep(1.0);

}  // namespace

CallbackThread::CallbackThread()
    : thread_([this] {
        while (queue_.isEnabled()) {
          queue_.callAvailable(kLongestSleep);
        }
      }) {}

CallbackThread::~CallbackThread() {
  queue_.disable();
  thread_.join();
}

std::shared_ptr<CallbackThread> CallbackThread::shared(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<CallbackThread>> threads;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<CallbackThread> thread = threads[name].lock();
  if (!thread) {
    thread = std::make_shared<CallbackThread>();
    threads[name] = thread;
  }
  return thread;
}

}  // namespace slipnav
