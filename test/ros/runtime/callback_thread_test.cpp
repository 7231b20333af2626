#include "ros/runtime/callback_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <chrono>
#include <functional>
#include <future>

namespace slipnav {
namespace {

class Call : public ros::CallbackInterface {
 public:
  explicit Call(std::function<void()> work) : work_(std::move(work)) {}
  CallResult call() override {
    work_();
    return Success;
  }

 private:
  std::function<void()> work_;
};

std::thread::id threadThatServes(CallbackThread& thread) {
  std::promise<std::thread::id> id;
  thread.queue().addCallback(boost::make_shared<Call>([&id] { id.set_value(std::this_thread::get_id()); }));
  return id.get_future().get();
}

TEST(CallbackThread, OneOfTheSameNameIsShared) {
  const std::shared_ptr<CallbackThread> first = CallbackThread::shared("/navigation");
  const std::shared_ptr<CallbackThread> second = CallbackThread::shared("/navigation");
  EXPECT_EQ(threadThatServes(*first), threadThatServes(*second));
  EXPECT_NE(threadThatServes(*first), threadThatServes(*CallbackThread::shared("/rover/navigation")));
}

TEST(CallbackThread, EndsWithItsLastUserAndBeginsAnew) {
  std::shared_ptr<CallbackThread> thread = CallbackThread::shared("/navigation");
  const std::weak_ptr<CallbackThread> observer = thread;
  thread.reset();
  EXPECT_TRUE(observer.expired());
  EXPECT_NE(threadThatServes(*CallbackThread::shared("/navigation")), std::this_thread::get_id());
}

TEST(CallbackThread, RepeatsWorkWhereItServesItsQueue) {
  CallbackThread thread;
  std::promise<std::thread::id> third_call;
  int calls = 0;
  const RepeatedWork work = thread.repeat(0.01, [&] {
    if (++calls == 3) {
      third_call.set_value(std::this_thread::get_id());
    }
  });
  EXPECT_EQ(third_call.get_future().get(), threadThatServes(thread));
}

TEST(CallbackThread, ServesItsQueueBetweenRepetitionsThatAreSeldom) {
  CallbackThread thread;
  std::atomic<int> calls{0};
  const RepeatedWork work = thread.repeat(3600.0, [&calls] { ++calls; });
  EXPECT_NE(threadThatServes(thread), std::this_thread::get_id());
  EXPECT_EQ(calls, 0);
}

TEST(CallbackThread, RepetitionEndsWithItsHandleThatWaitsForTheRunningCall) {
  CallbackThread thread;
  std::promise<void> begun;
  std::atomic<int> calls{0};
  std::atomic<bool> is_running{false};
  {
    const RepeatedWork work = thread.repeat(0.001, [&] {
      is_running = true;
      if (++calls == 1) {
        begun.set_value();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      is_running = false;
    });
    begun.get_future().get();
  }
  EXPECT_FALSE(is_running);
  const int calls_then = calls;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(calls, calls_then);
}

}  // namespace
}  // namespace slipnav
