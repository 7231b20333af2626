/// `simulate.launch operator:=true`: somebody drives a rover that is not there. The manager is killed meanwhile.

#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <signal.h>
#include <std_srvs/SetBool.h>

#include <cmath>
#include <functional>
#include <limits>

#include "ros/replay/node_process.h"

namespace slipnav {
namespace {

constexpr double kSpeed_mps = 0.6;
constexpr double kPatience_s = 30.0;
constexpr double kLongestRestart_s = 5.0;

class OperatedRover : public ::testing::Test {
 protected:
  OperatedRover() {
    truth_ = listen("truth/odometry",
                    [this](const nav_msgs::Odometry& truth) { speed_mps_ = std::abs(truth.twist.twist.linear.x); });
    odometry_ = listen("odometry", [this](const nav_msgs::Odometry& estimate) {
      estimated_s_ = now();
      estimate_ = estimate;
    });
  }

  ros::Subscriber listen(const std::string& topic, const std::function<void(const nav_msgs::Odometry&)>& take) {
    return node_.subscribe<nav_msgs::Odometry>(
        topic, 100,
        boost::function<void(const nav_msgs::Odometry::ConstPtr&)>([take](const auto& message) { take(*message); }));
  }

  static double now() { return ros::SteadyTime::now().toSec(); }

  /// The operator commands `wanted_mps_` meanwhile. @return how long it took; infinite when it did not happen
  double secondsUntil(const std::function<bool()>& condition, double limit_s = kPatience_s) {
    const double begin_s = now();
    while (!condition()) {
      if (now() - begin_s > limit_s) {
        return std::numeric_limits<double>::infinity();
      }
      geometry_msgs::Twist command;
      command.linear.x = wanted_mps_;
      commands_.publish(command);
      ros::WallDuration(0.05).sleep();
      ros::spinOnce();
    }
    return now() - begin_s;
  }

  bool navigates() const { return now() - estimated_s_ < 0.5; }
  bool drives() const { return speed_mps_ > 0.7 * kSpeed_mps; }
  bool stands() const { return speed_mps_ < 0.02; }

  void setEmergencyStop(bool on) {
    std_srvs::SetBool call;
    call.request.data = on ? 1 : 0;
    ASSERT_TRUE(ros::service::call("stop_supervisor/emergency_stop", call));
    EXPECT_TRUE(call.response.success) << call.response.message;
  }

  ros::NodeHandle node_;
  ros::Publisher commands_ = node_.advertise<geometry_msgs::Twist>("cmd_vel_in", 10);
  ros::Subscriber truth_;
  ros::Subscriber odometry_;
  nav_msgs::Odometry estimate_;
  double wanted_mps_ = 0.0;
  double speed_mps_ = 0.0;
  double estimated_s_ = -1e9;
};

TEST_F(OperatedRover, ObeysItsOperatorAndSurvivesTheManager) {
  ASSERT_LT(secondsUntil([this] { return navigates(); }), kPatience_s);
  EXPECT_TRUE(stands()) << "nobody has told it to drive";
  wanted_mps_ = kSpeed_mps;
  ASSERT_LT(secondsUntil([this] { return drives(); }), kPatience_s);
  EXPECT_NEAR((ros::Time::now() - estimate_.header.stamp).toSec(), 0.0, 2.0) << "time is that of the clock";

  const pid_t manager = pidOf("/slipnav_manager");
  ASSERT_EQ(kill(manager, SIGSTOP), 0);
  EXPECT_LT(secondsUntil([this] { return stands(); }, 5.0), 5.0) << "nobody passes commands on";
  ASSERT_EQ(kill(manager, SIGKILL), 0);
  EXPECT_LT(secondsUntil([this] { return navigates(); }), kLongestRestart_s);
  EXPECT_LT(secondsUntil([this] { return drives(); }), kPatience_s);

  setEmergencyStop(true);
  EXPECT_LT(secondsUntil([this] { return stands(); }, 5.0), 5.0);
  secondsUntil([] { return false; }, 2.0);
  EXPECT_TRUE(stands()) << "although the operator drives on";
  setEmergencyStop(false);
  EXPECT_LT(secondsUntil([this] { return drives(); }), kPatience_s);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "operated_rover");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
