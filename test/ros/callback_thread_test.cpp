#include "slipnav/ros/callback_thread.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
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

}  // namespace
}  // namespace slipnav
