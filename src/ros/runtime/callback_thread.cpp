#include "ros/runtime/callback_thread.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace slipnav {
namespace {

constexpr double kLongestSleep_s = 1.0;

using Clock = std::chrono::steady_clock;

Clock::duration clockDuration(double interval_s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(interval_s));
}

}  // namespace

struct RepeatedWork::Task {
  Clock::duration interval;
  Clock::time_point next;  ///< used only by the thread
  std::mutex mutex;        ///< held while the work is done
  std::function<void()> work;
};

RepeatedWork& RepeatedWork::operator=(RepeatedWork&& other) noexcept {
  end();
  task_ = std::move(other.task_);
  return *this;
}

void RepeatedWork::end() {
  if (task_) {
    const std::lock_guard<std::mutex> lock(task_->mutex);
    task_->work = nullptr;
  }
  task_.reset();
}

CallbackThread::CallbackThread() : thread_([this] { run(); }) {}

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

RepeatedWork CallbackThread::repeat(double interval_s, std::function<void()> work) {
  const auto task = std::make_shared<RepeatedWork::Task>();
  task->interval = clockDuration(interval_s);
  task->next = Clock::now() + task->interval;
  task->work = std::move(work);
  const std::lock_guard<std::mutex> lock(mutex_);
  tasks_.push_back(task);
  return RepeatedWork(task);
}

void CallbackThread::run() {
  while (queue_.isEnabled()) {
    queue_.callAvailable(ros::WallDuration(secondsUntilWork()));
    doWork();
  }
}

double CallbackThread::secondsUntilWork() {
  const Clock::time_point now = Clock::now();
  Clock::duration sleep = clockDuration(kLongestSleep_s);
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& task : tasks_) {
    sleep = std::min(sleep, task->next - now);
  }
  return std::max(0.0, std::chrono::duration<double>(sleep).count());
}

void CallbackThread::doWork() {
  const Clock::time_point now = Clock::now();
  std::vector<std::shared_ptr<RepeatedWork::Task>> due;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::copy_if(tasks_.begin(), tasks_.end(), std::back_inserter(due),
                 [now](const auto& task) { return task->next <= now; });
  }
  for (const auto& task : due) {
    const std::lock_guard<std::mutex> lock(task->mutex);
    if (task->work) {
      task->work();
      task->next = now + task->interval;
    } else {
      const std::lock_guard<std::mutex> list_lock(mutex_);
      tasks_.erase(std::remove(tasks_.begin(), tasks_.end(), task), tasks_.end());
    }
  }
}

}  // namespace slipnav
