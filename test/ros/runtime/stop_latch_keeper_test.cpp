#include "ros/runtime/stop_latch_keeper.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace slipnav {
namespace {

class StopLatchKeeperTest : public ::testing::Test {
 protected:
  StopLatchKeeperTest() { setenv("ROS_HOME", "/home_of_ros", 1); }
  ~StopLatchKeeperTest() override { unsetenv("ROS_HOME"); }

  std::string file() const { return StopLatchKeeper(params_, "/a/stop_supervisor").file(); }

  CheckpointParams params_;
};

TEST_F(StopLatchKeeperTest, IsNamedAfterTheNodelet) {
  EXPECT_EQ(file(), "/home_of_ros/slipnav_a_stop_supervisor.stop");
}

TEST_F(StopLatchKeeperTest, LiesBesideTheCheckpoint) {
  params_.file = "/var/lib/rover/state";
  EXPECT_EQ(file(), "/var/lib/rover/state.stop");
}

TEST_F(StopLatchKeeperTest, OutlastsALaunch) {
  params_.launch_file = "/tmp/of_this_launch";
  EXPECT_EQ(file(), "/home_of_ros/slipnav_a_stop_supervisor.stop");
}

TEST_F(StopLatchKeeperTest, IsWhereItIsToldToBe) {
  params_.file = "/var/lib/rover/state";
  params_.stop_file = "/else/where";
  EXPECT_EQ(file(), "/else/where");
  params_.stop_file = "none";
  EXPECT_EQ(file(), "");
}

}  // namespace
}  // namespace slipnav
