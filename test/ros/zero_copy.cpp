/// Messages between nodelets of one process are the same objects on both sides: nothing is serialised or copied.

#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <slipnav/InsSteps.h>
#include <slipnav/StartState.h>

#include <boost/make_shared.hpp>

#include "slipnav/ros/internal_topics.h"

namespace slipnav {
namespace {

class ZeroCopy : public ::testing::Test {
 protected:
  void load(const std::string& name, const std::string& type) {
    ASSERT_TRUE(loader_.load(name, type, nodelet::M_string(), nodelet::V_string()));
  }

  /// Publishes and waits until somebody else holds the very object.
  template <class Message>
  void expectHeld(const std::string& topic, const boost::shared_ptr<Message>& message) {
    ros::Publisher publisher = node_.advertise<Message>(topic, 1);
    const auto has_subscriber = [&publisher] { return publisher.getNumSubscribers() > 0; };
    ASSERT_TRUE(waitUntil(has_subscriber));
    publisher.publish(boost::shared_ptr<const Message>(message));
    EXPECT_TRUE(waitUntil([&message] { return message.use_count() > 1; }));
    ros::WallDuration(0.5).sleep();  // what only sits in a queue is gone by now
    EXPECT_GT(message.use_count(), 1);
  }

  template <class Condition>
  static bool waitUntil(Condition condition) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    while (!condition() && (ros::SteadyTime::now() - begin).toSec() < 10.0) {
      ros::WallDuration(0.01).sleep();
    }
    return condition();
  }

  ros::NodeHandle node_;
  nodelet::Loader loader_{false};
};

TEST_F(ZeroCopy, InsKeepsTheInitialStateThatItWaitsWith) {
  load("/ins", "slipnav/Ins");
  const auto state = boost::make_shared<StartState>();
  state->known = true;
  state->state.stamp = ros::Time(100.0);  // no sample has come so far
  expectHeld(kInitialStateTopic, state);
}

TEST_F(ZeroCopy, FilterKeepsTheStepsThatOvertookTheirInitialState) {
  load("/filter", "slipnav/Filter");
  const auto steps = boost::make_shared<InsSteps>();
  steps->start = 1;
  steps->steps.resize(1);
  expectHeld(kInsStepsTopic, steps);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "zero_copy");
  ros::NodeHandle keep_alive;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
