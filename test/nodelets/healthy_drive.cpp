/// All nodelets on a drive where nothing is wrong: from the start on, not one says otherwise.

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <cmath>

#include "diagnosed_rover.h"

namespace slipnav {
namespace {

constexpr double kPatience_s = 60.0;
constexpr double kWatched_m = 150.0;

/// How far the rover has driven since this was made [m].
class Odometer {
 public:
  explicit Odometer(ros::NodeHandle& node) {
    const boost::function<void(const nav_msgs::Odometry::ConstPtr&)> take =
        [this](const nav_msgs::Odometry::ConstPtr& estimate) {
          if (!last_.isZero()) {
            distance_m_ += std::abs(estimate->twist.twist.linear.x) * (estimate->header.stamp - last_).toSec();
          }
          last_ = estimate->header.stamp;
        };
    subscriber_ = node.subscribe<nav_msgs::Odometry>("odometry", 1000, take);
  }

  double distance_m() const { return distance_m_; }

 private:
  ros::Subscriber subscriber_;
  ros::Time last_;
  double distance_m_ = 0.0;
};

TEST(HealthyDrive, IsReportedAsOne) {
  ros::NodeHandle node;
  Diagnoses diagnoses(node);
  const auto fit = [&diagnoses] { return diagnoses.of("fit to drive").message == "fit to drive"; };
  const ros::SteadyTime begin = ros::SteadyTime::now();
  while (!fit() && (ros::SteadyTime::now() - begin).toSec() < kPatience_s) {
    ros::spinOnce();
    ros::WallDuration(0.05).sleep();
  }
  ASSERT_TRUE(fit()) << diagnoses.complaints();
  const Odometer odometer(node);
  while (ros::ok() && odometer.distance_m() < kWatched_m) {
    ros::spinOnce();
    ASSERT_EQ(diagnoses.complaints(), "") << odometer.distance_m() << " m after the start";
    ros::WallDuration(0.02).sleep();
  }
  EXPECT_GE(odometer.distance_m(), kWatched_m);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "healthy_drive");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
