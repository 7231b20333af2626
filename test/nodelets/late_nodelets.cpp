/// Nodelets are loaded in any order and with any delay: whoever comes late misses nothing that the estimate needs.

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include <atomic>
#include <cctype>
#include <string>
#include <vector>

#include "ros/runtime/parameters.h"
#include "ros/simulated_bag.h"

namespace slipnav {
namespace {

constexpr double kRate = 5.0;
constexpr double kLate_s = 6.0;  // of the recording: the initial state is found before

/// The nodelets in the order in which they are loaded; the last one is late.
class LateNodelets : public ::testing::TestWithParam<std::vector<std::string>> {
 protected:
  LateNodelets() {
    const boost::function<void(const nav_msgs::Odometry::ConstPtr&)> note =
        [this](const nav_msgs::Odometry::ConstPtr& message) { newest_ = message->header.stamp.toSec(); };
    listener_ = node_.subscribe<nav_msgs::Odometry>(config_.topics.odometry, 0, note);
    imu_ = node_.advertise<sensor_msgs::Imu>(config_.topics.imu, 0);
    wheels_ = node_.advertise<sensor_msgs::JointState>(config_.topics.joint_states, 0);
  }

  void load(const std::string& name) {
    const std::string type = "slipnav/" + std::string(1, static_cast<char>(std::toupper(name[0]))) + name.substr(1);
    ASSERT_TRUE(loader_.load("/" + name, type, nodelet::M_string(), nodelet::V_string()));
  }

  void publish(const rosbag::MessageInstance& instance) const {
    if (const sensor_msgs::Imu::ConstPtr imu = instance.instantiate<sensor_msgs::Imu>()) {
      imu_.publish(imu);
    } else if (const sensor_msgs::JointState::ConstPtr wheels = instance.instantiate<sensor_msgs::JointState>()) {
      wheels_.publish(wheels);
    }
  }

  ros::NodeHandle node_;
  Config config_ = configFromParameters(node_, "slipnav");
  nodelet::Loader loader_{false};
  ros::Subscriber listener_;
  ros::Publisher imu_;
  ros::Publisher wheels_;
  std::atomic<double> newest_ = 0.0;
};

TEST_P(LateNodelets, TheEstimateComesAllTheSame) {
  const test::TemporaryBag bag;
  test::writeShortDrive(bag.path(), config_);
  for (std::size_t i = 0; i + 1 < GetParam().size(); ++i) {
    load(GetParam()[i]);
  }
  rosbag::Bag recording(bag.path());
  rosbag::View view(recording);
  const ros::SteadyTime begin = ros::SteadyTime::now();
  bool all_loaded = false;
  for (const rosbag::MessageInstance& instance : view) {
    const double recorded_s = (instance.getTime() - view.getBeginTime()).toSec();
    while ((ros::SteadyTime::now() - begin).toSec() < recorded_s / kRate) {
      ros::WallDuration(0.001).sleep();
    }
    if (!all_loaded && recorded_s > kLate_s) {
      load(GetParam().back());
      all_loaded = true;
    }
    publish(instance);
  }
  ros::WallDuration(1.0).sleep();
  EXPECT_NEAR(newest_, view.getEndTime().toSec(), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Order, LateNodelets,
                         ::testing::Values(std::vector<std::string>{"filter", "initializer", "ins"},
                                           std::vector<std::string>{"ins", "initializer", "filter"},
                                           std::vector<std::string>{"filter", "ins", "initializer"}),
                         [](const auto& order) { return order.param.back(); });

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "late_nodelets");
  ros::NodeHandle keep_alive;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
