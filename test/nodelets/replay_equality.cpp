/// What the nodelets make of a recording, played fast, against the offline run: the same numbers to the last bit.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <signal.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <slipnav/StartState.h>

#include <limits>
#include <map>
#include <string>
#include <thread>

#include "replay_fixture.h"
#include "ros/replay/node_process.h"
#include "ros/runtime/internal_topics.h"

namespace slipnav {
namespace {

class ReplayEquality : public test::ReplayFixture {};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Keeps whether each status has been well, by its name. When the recording has ended the sensors are silent.
ros::Subscriber listenToDiagnostics(std::map<std::string, bool>& well) {
  const boost::function<void(const diagnostic_msgs::DiagnosticArray::ConstPtr&)> note =
      [&well](const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
        for (const diagnostic_msgs::DiagnosticStatus& status : message->status) {
          bool& was_well = well[status.name];
          was_well = was_well || status.level == diagnostic_msgs::DiagnosticStatus::OK;
        }
      };
  return ros::NodeHandle().subscribe<diagnostic_msgs::DiagnosticArray>("/diagnostics", 100, note);
}

/// Slow enough for reports, twice a second of real time, between the start and the end of a short drive.
TEST_F(ReplayEquality, AtFourTimesRealTimeAllAreWell) {
  std::map<std::string, bool> well;
  ros::Subscriber diagnostics = listenToDiagnostics(well);
  const BagEvaluation offline = replayAndCompare(bag_->path(), 4.0);
  EXPECT_TRUE(offline.problems.empty());
  EXPECT_LT(offline.report.metrics.horizontal_max_m.value(), 1.0);
  const std::map<std::string, bool> everyone = {{"filter: /filter", true},
                                                {"forecast: /forecast", true},
                                                {"initializer: /initializer", true},
                                                {"ins: /ins", true},
                                                {"stop_supervisor: /fit to drive", true},
                                                {"stop_supervisor: /stop_supervisor", true}};
  for (int i = 0; i < 50 && well != everyone; ++i) {  // they come twice a second
    ros::spinOnce();
    ros::WallDuration(0.1).sleep();
  }
  EXPECT_EQ(well, everyone);
}

TEST_F(ReplayEquality, AgainAfterTheClockWentBackAndAsFastAsItGoes) { replayAndCompare(bag_->path(), 100.0); }

TEST_F(ReplayEquality, WithSamplesThatCannotBeUsed) {
  test::TemporaryBag broken;
  int imu_count = 0;
  int wheel_count = 0;
  test::editBag(bag_->path(), broken.path(), [&](const rosbag::MessageInstance& instance, rosbag::Bag& target) {
    const auto imu = instance.instantiate<sensor_msgs::Imu>();
    const auto joints = instance.instantiate<sensor_msgs::JointState>();
    if (imu) {
      sensor_msgs::Imu edited = *imu;
      ++imu_count;
      edited.linear_acceleration.x = imu_count % 97 == 0 ? kNan : edited.linear_acceleration.x;
      edited.angular_velocity.z = imu_count % 151 == 0 ? 1e6 : edited.angular_velocity.z;
      target.write(instance.getTopic(), instance.getTime(), edited);
    } else if (joints) {
      sensor_msgs::JointState edited = *joints;
      ++wheel_count;
      if (wheel_count % 31 == 0) {
        edited.velocity[2] = kNan;
      } else if (wheel_count % 37 == 0) {
        edited.name[1] = "nonsense";
      } else if (wheel_count % 41 == 0) {
        edited.velocity.pop_back();
      }
      target.write(instance.getTopic(), instance.getTime(), edited);
    } else {
      target.write(instance.getTopic(), instance.getTime(), instance);
    }
  });
  const BagEvaluation offline = replayAndCompare(broken.path(), 20.0);
  EXPECT_GE(offline.problems.size(), 2U);
  EXPECT_GT(offline.report.metrics.rejected_samples, 20);
  for (const EstimateSample& estimate : offline.report.estimates) {
    ASSERT_TRUE(estimate.position_enu_m.allFinite());
  }
}

/// As `rosbag record` of a live drive has them: outputs of another run, and what the operator commanded.
TEST_F(ReplayEquality, WhatTheNodeletsSaidWhenItWasRecordedIsNotPlayed) {
  test::TemporaryBag recorded;
  test::editBag(bag_->path(), recorded.path(), [](const rosbag::MessageInstance& instance, rosbag::Bag& target) {
    target.write(instance.getTopic(), instance.getTime(), instance);
    if (const auto imu = instance.instantiate<sensor_msgs::Imu>()) {
      const auto put = [&](const std::string& topic, auto message) {
        message.header.stamp = imu->header.stamp;
        target.write("/" + topic, instance.getTime(), message);
      };
      put(config_->topics.odometry, nav_msgs::Odometry());
      put(config_->topics.nav_state, NavState());
      put(config_->topics.slip, Slip());
      target.write("/" + config_->topics.cmd_vel_in, instance.getTime(), geometry_msgs::Twist());
      target.write(std::string("/") + kInitialStateTopic, instance.getTime(), StartState());
    }
  });
  int commands = 0;
  const boost::function<void(const geometry_msgs::Twist::ConstPtr&)> count =
      [&commands](const geometry_msgs::Twist::ConstPtr&) { ++commands; };
  const ros::Subscriber base = ros::NodeHandle().subscribe<geometry_msgs::Twist>(config_->topics.cmd_vel, 10, count);
  replayAndCompare(recorded.path(), 20.0);
  EXPECT_EQ(commands, 0) << "nothing moves";
}

TEST_F(ReplayEquality, WithWheelsSilentForAWhile) {
  test::TemporaryBag silent;
  const Nanoseconds begin = fromSeconds(config_->simulator.start_time_s + 28.0);
  test::editBag(bag_->path(), silent.path(), [begin](const rosbag::MessageInstance& instance, rosbag::Bag& target) {
    const Nanoseconds stamp = static_cast<Nanoseconds>(instance.getTime().toNSec());
    const bool in_gap = stamp > begin && stamp < begin + fromSeconds(5.0);
    if (!(in_gap && instance.isType<sensor_msgs::JointState>())) {
      target.write(instance.getTopic(), instance.getTime(), instance);
    }
  });
  replayAndCompare(silent.path(), 20.0);
}

/// As on a machine that is busy with other things: all is published before the nodelets have taken much of it. The
/// wheels may then lag for so long that they pass for silent, so only that every estimate comes is certain.
TEST_F(ReplayEquality, WhatIsOnItsWayWhenTheRecordingEndsIsDelivered) {
  const pid_t manager = pidOf("/slipnav_manager");
  ASSERT_GT(manager, 0);
  std::thread wake;
  const boost::function<void(const sensor_msgs::Imu::ConstPtr&)> stall = [&](const sensor_msgs::Imu::ConstPtr&) {
    if (!wake.joinable()) {
      kill(manager, SIGSTOP);
      wake = std::thread([manager] {
        ros::WallDuration(2.0).sleep();
        kill(manager, SIGCONT);
      });
    }
  };
  const ros::Subscriber first_sample = ros::NodeHandle().subscribe<sensor_msgs::Imu>(config_->topics.imu, 1, stall);
  const EstimateTrack offline = evaluateBag(bag_->path(), *config_, "", {}).report.estimates;
  session_->play({bag_->path(), 100.0, 0.0, 0.0}, offline.back().stamp);
  ASSERT_TRUE(wake.joinable());
  wake.join();
  const EstimateTrack replayed = session_->recorder().track();
  ASSERT_FALSE(replayed.empty());
  EXPECT_EQ(replayed.size(), offline.size());
  EXPECT_EQ(replayed.back().stamp, offline.back().stamp);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "replay_equality");
  return RUN_ALL_TESTS();
}
