/// The parameter use_sim_time without anybody who publishes /clock, as a simulation leaves it behind.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/Imu.h>

#include <functional>
#include <optional>

#include "diagnosed_rover.h"

namespace slipnav {
namespace {

constexpr const char* kWords = "use_sim_time is set, but nobody publishes /clock";

class MissingClock : public ::testing::Test {
 protected:
  /// The IMU continues meanwhile. @return whether it happened within the time
  bool happensWithin(double limit_s, const std::function<bool()>& condition) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    while (!condition() && (ros::SteadyTime::now() - begin).toSec() < limit_s) {
      sensor_msgs::Imu imu;
      imu.header.stamp = ros::Time(1e9 + ros::WallTime::now().toSec() - begin_.toSec());
      imu.linear_acceleration.z = 9.8;
      imu_.publish(imu);
      if (clock_) {
        rosgraph_msgs::Clock clock;
        clock.clock = imu.header.stamp;
        clock_->publish(clock);
      }
      ros::WallDuration(0.02).sleep();
      ros::spinOnce();
    }
    return condition();
  }

  ros::NodeHandle node_;
  ros::WallTime begin_ = ros::WallTime::now();
  ros::Publisher imu_ = node_.advertise<sensor_msgs::Imu>("imu/data", 10);
  std::optional<ros::Publisher> clock_;
  Diagnoses diagnoses_{node_};
};

TEST_F(MissingClock, IsNamedAndNoMoreOnceItComes) {
  ASSERT_TRUE(happensWithin(20.0, [this] { return imu_.getNumSubscribers() > 0 && diagnoses_.has("ins"); }));
  EXPECT_TRUE(happensWithin(2.0, [this] { return diagnoses_.complains("ins", kWords); })) << diagnoses_.complaints();
  EXPECT_EQ(diagnoses_.of("ins").level, diagnostic_msgs::DiagnosticStatus::ERROR);
  clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  EXPECT_TRUE(happensWithin(2.0, [this] { return !diagnoses_.complains("ins", kWords); })) << diagnoses_.complaints();
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "missing_clock");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
