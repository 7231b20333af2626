#include "ros/messages/imu_input.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

sensor_msgs::Imu message(const std::string& frame_id) {
  sensor_msgs::Imu imu;
  imu.header.stamp = ros::Time(5, 0);
  imu.header.frame_id = frame_id;
  imu.linear_acceleration.z = 9.8;
  return imu;
}

TEST(ImuInput, takesTheFirstOfTwoSensors) {
  ImuInput input{Config()};
  EXPECT_TRUE(input.take(message("front_imu")));
  EXPECT_FALSE(input.take(message("rear_imu")));
  EXPECT_EQ(
      input.problem(),
      "imu/data comes from two sensors: frame_id 'front_imu' is used, 'rear_imu' is ignored; give each driver its "
      "own topic, or set frames.imu");
  EXPECT_TRUE(input.take(message("/front_imu")));
  EXPECT_EQ(input.problem(), "");
}

TEST(ImuInput, takesTheConfiguredOneOfTwoSensors) {
  Config config;
  config.frames.imu = "rear_imu";
  ImuInput input(config);
  EXPECT_TRUE(input.take(message("front_imu")));
  EXPECT_TRUE(input.take(message("rear_imu")));
  EXPECT_FALSE(input.take(message("front_imu")));
}

TEST(ImuInput, leavesOutWhatIsSaidToBeAbsent) {
  ImuInput input{Config()};
  sensor_msgs::Imu absent = message("imu_link");
  absent.linear_acceleration_covariance[0] = -1.0;
  EXPECT_FALSE(input.take(absent));
  EXPECT_NE(input.problem().find("no linear acceleration"), std::string::npos);
  absent = message("imu_link");
  absent.angular_velocity_covariance[0] = -1.0;
  EXPECT_FALSE(input.take(absent));
  EXPECT_NE(input.problem().find("no angular velocity"), std::string::npos);
  absent = message("imu_link");
  absent.orientation_covariance[0] = -1.0;  // it is not used
  EXPECT_TRUE(input.take(absent));
}

TEST(ImuInput, namesStampsThatAreNotSet) {
  ImuInput input{Config()};
  sensor_msgs::Imu unstamped = message("imu_link");
  unstamped.header.stamp = ros::Time();
  EXPECT_FALSE(input.take(unstamped));
  EXPECT_EQ(input.problem(), "stamps of imu/data are zero");
}

}  // namespace
}  // namespace slipnav
