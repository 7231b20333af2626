/// The manager of the launch files as a process: it loads its nodelets, and deletes the state of the launch only when
/// the launch ends.

#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <ros/ros.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ros/replay/node_process.h"
#include "ros/runtime/child_process.h"

namespace slipnav {
namespace {

constexpr double kPatience_s = 20.0;
constexpr double kDisturbance_s = 3.0;  // in which a second manager of the same name would end the first

class ManagerProcess : public ::testing::Test {
 protected:
  ManagerProcess() {
    node_.setParam("slipnav/checkpoint/launch_file", state_);
    node_.setParam("slipnav/checkpoint/stop_file", "none");
    std::ofstream(state_) << "of this launch";
  }
  ~ManagerProcess() override { std::filesystem::remove(state_); }

  static std::unique_ptr<ChildProcess> run(const std::vector<std::string>& nodelets) {
    std::vector<std::string> command = {packageExecutable("manager"), "__ns:=/rover", "__name:=manager"};
    command.insert(command.end(), nodelets.begin(), nodelets.end());
    return std::make_unique<ChildProcess>(command);
  }

  static std::vector<std::string> loaded() {
    nodelet::NodeletList list;
    ros::service::call("/rover/manager/list", list);
    return list.response.nodelets;
  }

  static bool waitUntil(const std::function<bool()>& condition, double limit_s = kPatience_s) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    while (!condition() && (ros::SteadyTime::now() - begin).toSec() < limit_s) {
      ros::WallDuration(0.05).sleep();
    }
    return condition();
  }

  /// Its exit status; negative if it did not arrive in time.
  static int endWith(int signal, ChildProcess& process) {
    if (!waitUntil([] { return loaded().size() == 2; })) {
      return -1;
    }
    return kill(pidOf("/rover/manager"), signal) == 0 ? process.wait() : -1;
  }

  bool stateIsThere() const { return std::filesystem::exists(state_); }

  ros::NodeHandle node_{"/rover"};
  const std::string state_ = ::testing::TempDir() + "slipnav_manager_process_" + std::to_string(getpid());
  const std::vector<std::string> nodelets_ = {"supervisor=slipnav/StopSupervisor", "deep/forecast=slipnav/Forecast"};
};

TEST_F(ManagerProcess, LoadsWhatItIsToldInItsNamespace) {
  const std::unique_ptr<ChildProcess> manager = run(nodelets_);
  waitUntil([] { return loaded().size() == 2; });
  EXPECT_EQ(loaded(), (std::vector<std::string>{"/rover/deep/forecast", "/rover/supervisor"}));
}

TEST_F(ManagerProcess, TheStateOfALaunchEndsWithTheLaunch) {
  EXPECT_EQ(endWith(SIGINT, *run(nodelets_)), 0);
  EXPECT_FALSE(stateIsThere());
}

TEST_F(ManagerProcess, TheStateOfALaunchOutlastsItsManager) {
  for (const int signal : {SIGKILL, SIGTERM}) {
    EXPECT_EQ(endWith(signal, *run(nodelets_)), 128 + signal);
    EXPECT_TRUE(stateIsThere());
  }
}

/// Two launches by mistake: ROS would end the first one, which its roslaunch restarts, and so on.
TEST_F(ManagerProcess, ASecondOneWaitsForTheEndOfTheFirst) {
  const std::unique_ptr<ChildProcess> first = run(nodelets_);
  ASSERT_TRUE(waitUntil([] { return loaded().size() == 2; }));
  const pid_t running = pidOf("/rover/manager");
  const std::unique_ptr<ChildProcess> second = run(nodelets_);
  EXPECT_FALSE(waitUntil([&first] { return first->poll().has_value(); }, kDisturbance_s));
  run(nodelets_).reset();  // ended while it waits
  EXPECT_TRUE(stateIsThere());
  EXPECT_EQ(pidOf("/rover/manager"), running);
  ASSERT_EQ(kill(running, SIGKILL), 0);
  first->wait();
  EXPECT_TRUE(waitUntil([] { return loaded().size() == 2; })) << "the second takes over";
}

TEST_F(ManagerProcess, SaysWhatItCannotLoad) {
  EXPECT_EQ(run({"ins=slipnav/Misspelt"})->wait(), 1);
  EXPECT_EQ(run({"slipnav/Ins"})->wait(), 2);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "manager_process");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
