/// roslaunch understands every launch file, with the arguments that users give.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <string>
#include <vector>

#include "ros/runtime/child_process.h"

namespace slipnav {
namespace {

/// Exit status of a dry run that reads everything and starts nothing.
int roslaunchStatus(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {"roslaunch", "--nodes", "slipnav"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return ChildProcess(command).wait();
}

TEST(LaunchFiles, AreUnderstood) {
  EXPECT_EQ(roslaunchStatus({"nodelets.launch"}), 0);
  EXPECT_EQ(roslaunchStatus({"rover.launch", "namespace:=/rover", "rviz:=true"}), 0);
  EXPECT_EQ(
      roslaunchStatus({"rover.launch", "config:=pathfinder", "topics:=imu/data=imu joint_states=wheels",
                       "frames:=base=rover imu=imu0", "extrinsics:=tf", "stop_mode:=active", "checkpoint:=/tmp/state"}),
      0);
  EXPECT_EQ(roslaunchStatus({"replay.launch", "bag:=drive.bag", "config:=default,husky_mocap", "out:=somewhere",
                             "report:=true", "truth:=truth/fix", "options:=--set planet=mars"}),
            0);
  EXPECT_EQ(roslaunchStatus({"simulate.launch", "terrain:=gravel", "distance:=10", "seed:=7", "policy:=periodic:12:3",
                             "rate:=5", "out:=somewhere", "report:=true", "rviz:=true"}),
            0);
  EXPECT_EQ(roslaunchStatus({"simulate.launch", "apart:=true", "endurance:=1", "out:=somewhere"}), 0);
  EXPECT_EQ(roslaunchStatus({"simulate.launch", "operator:=true", "terrain:=paved", "stop_mode:=advise",
                             "options:=--set gnss.use=always"}),
            0);
  EXPECT_EQ(roslaunchStatus({"load.launch", "bag:=drive.bag", "seconds:=5", "out:=table.txt"}), 0);
}

TEST(LaunchFiles, AWrongConfigurationIsAnError) {
  EXPECT_NE(roslaunchStatus({"nodelets.launch", "config:=nonsense"}), 0);
  EXPECT_NE(roslaunchStatus({"nodelets.launch", "options:=--set planet=pluto"}), 0);
  EXPECT_NE(roslaunchStatus({"simulate.launch", "terrain:=sea"}), 0);
  EXPECT_NE(roslaunchStatus({"rover.launch", "topics:=imu/dota=imu"}), 0);
  EXPECT_NE(roslaunchStatus({"rover.launch", "stop_mode:=sometimes"}), 0);
  EXPECT_NE(roslaunchStatus({"rover.launch", "config:=pathfinder", "init_params:=/nowhere/init_params.yaml"}), 0);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "launch_files");
  return RUN_ALL_TESTS();
}
