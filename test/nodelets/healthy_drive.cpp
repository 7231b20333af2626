/// All nodelets on a drive where nothing is wrong: from the start on, not one says otherwise.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include "diagnosed_rover.h"

namespace slipnav {
namespace {

constexpr double kPatience_s = 60.0;
constexpr double kWatched_s = 150.0;  // of the drive

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
  const ros::Time start = ros::Time::now();
  while (ros::ok() && (ros::Time::now() - start).toSec() < kWatched_s) {
    ros::spinOnce();
    ASSERT_EQ(diagnoses.complaints(), "") << (ros::Time::now() - start).toSec() << " s after the start";
    ros::WallDuration(0.02).sleep();
  }
  EXPECT_GE((ros::Time::now() - start).toSec(), kWatched_s);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "healthy_drive");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
