#include "ros/bag/bag_poses.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <std_msgs/String.h>

#include <limits>

#include "ros/simulated_bag.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::messageOf;
using test::TemporaryBag;

nav_msgs::Odometry odometryAt(double stamp_s) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(stamp_s);
  message.pose.pose.position.x = 2.0 * stamp_s;
  message.pose.pose.orientation.z = 1.0;
  return message;
}

class BagPoses : public ::testing::Test {
 protected:
  BagPoses() {
    rosbag::Bag bag(bag_.path(), rosbag::bagmode::Write);
    for (int i = 1; i <= 5; ++i) {
      // Recorded later than stamped, as everything is.
      bag.write("/vio/odometry", ros::Time(100.0 + i + 0.3), odometryAt(100.0 + i));
      bag.write("/words", ros::Time(100.0 + i), std_msgs::String());
    }
    nav_msgs::Odometry lost = odometryAt(106.0);
    lost.pose.pose.position.y = std::numeric_limits<double>::quiet_NaN();
    bag.write("/vio/odometry", ros::Time(106.0), lost);
    nav_msgs::Odometry without_attitude = odometryAt(107.0);
    without_attitude.pose.pose.orientation.z = 0.0;
    bag.write("/vio/odometry", ros::Time(107.0), without_attitude);
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.stamp = ros::Time(103.5);
    pose.pose.pose.position.z = 7.0;
    pose.pose.pose.orientation.w = 1.0;
    bag.write("ekf/pose", ros::Time(104.0), pose);
    bag.close();
  }

  TemporaryBag bag_;
};

TEST_F(BagPoses, ComeByTheStampOfTheirHeader) {
  const std::vector<TumPose> poses = readPoses({bag_.path()}, "vio/odometry");
  ASSERT_EQ(poses.size(), 5U) << "anything but a pose is skipped";
  EXPECT_EQ(poses[2].stamp, fromSeconds(103.0));
  EXPECT_DOUBLE_EQ(poses[2].position_enu_m.x(), 206.0);
  EXPECT_DOUBLE_EQ(poses[2].q_flu_to_enu.z(), 1.0);
}

TEST_F(BagPoses, OfOtherTypes) {
  const std::vector<TumPose> poses = readPoses({bag_.path()}, "/ekf/pose");
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_DOUBLE_EQ(poses[0].position_enu_m.z(), 7.0);
}

TEST_F(BagPoses, ATopicThatIsNotThereIsNamed) {
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { readPoses({bag_.path()}, "/vio/pose"); }),
            bag_.path() + ": no topic '/vio/pose' to compare with");
}

TEST_F(BagPoses, ATopicWithoutPosesIsNamed) {
  EXPECT_NE(messageOf<std::invalid_argument>([&] {
              readPoses({bag_.path()}, "/words");
            }).find("'/words' is of type std_msgs/String, which is not one of nav_msgs/Odometry"),
            std::string::npos);
}

}  // namespace
}  // namespace slipnav
