/// A rover whose sensors and base fail one after the other, in real time: within two seconds a nodelet says so and why,
/// and within two seconds of the end it has stopped to.

#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/SetBool.h>

#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>

#include "diagnosed_rover.h"
#include "evaluation/simulated_drive.h"
#include "ros/messages/conversions.h"
#include "ros/messages/simulated_sensors.h"
#include "ros/runtime/parameters.h"

namespace slipnav {
namespace {

constexpr double kWithin_s = 2.0;
constexpr double kSpeed_mps = 0.8;
constexpr double kPatience_s = 30.0;

class Diagnostics : public ::testing::Test {
 protected:
  /// Changes a message, or drops it (false).
  template <class Message>
  using Fault = std::function<bool(Message&)>;

  Diagnostics() {
    base_ = node_.subscribe<geometry_msgs::Twist>(config_.topics.cmd_vel, 100,
                                                  boost::function<void(const geometry_msgs::Twist::ConstPtr&)>(
                                                      [this](const auto& message) { told_mps_ = message->linear.x; }));
    estimates_ = node_.subscribe<nav_msgs::Odometry>(
        config_.topics.odometry, 100,
        boost::function<void(const nav_msgs::Odometry::ConstPtr&)>([this](const auto&) { ++estimates_heard_; }));
  }

  static double now() { return ros::SteadyTime::now().toSec(); }

  /// One interval of the rover at its own pace, and what comes meanwhile.
  void step() {
    geometry_msgs::Twist wanted;
    wanted.linear.x = wanted_mps_;
    commands_.publish(wanted);
    VelocityCommand command;
    command.linear_mps.x() = obeys_ ? told_mps_ : wanted_mps_;
    const sim::Measurements measured = rover_.execute(command);
    if (measured.wheel) {
      sensor_msgs::JointState joints = sensors_.joints(*measured.wheel, measured.wheel_angle_rad);
      if (!on_joints_ || on_joints_(joints)) {
        joints_.publish(joints);
      }
    }
    sensor_msgs::Imu imu = sensors_.imu(measured.imu);
    if (!on_imu_ || on_imu_(imu)) {
      imu_.publish(imu);
    }
    due_s_ = std::max(due_s_ + toSeconds(measured.imu.stamp - newest_), now() - 0.1);
    newest_ = measured.imu.stamp;
    do {
      ros::spinOnce();
      ros::WallDuration(0.001).sleep();
    } while (now() < due_s_);
  }

  /// @return how long it took; infinite when it did not happen in time
  double secondsUntil(const std::function<bool()>& condition, double limit_s = kPatience_s) {
    const double begin_s = now();
    while (!condition()) {
      if (now() - begin_s > limit_s) {
        return std::numeric_limits<double>::infinity();
      }
      step();
    }
    return now() - begin_s;
  }

  void goOn(double duration_s) {
    secondsUntil([] { return false; }, duration_s);
  }

  void start() {
    const auto connected = [this] {
      return imu_.getNumSubscribers() > 0 && joints_.getNumSubscribers() > 0 && commands_.getNumSubscribers() > 0 &&
             base_.getNumPublishers() > 0;
    };
    const double begin_s = now();
    while (!connected() && now() - begin_s < kPatience_s) {
      ros::WallDuration(0.01).sleep();
    }
    ASSERT_TRUE(connected());
    due_s_ = now();
    newest_ = rover_.truth().stamp;
    ASSERT_LT(secondsUntil([this] { return estimates_heard_ > 0; }), kPatience_s) << diagnoses_.complaints();
    wanted_mps_ = kSpeed_mps;
    goOn(6.0);
    ASSERT_EQ(diagnoses_.of(kFitToDriveStatus).message, "fit to drive") << diagnoses_.complaints();
  }

  void expectAlarm(const std::string& nodelet, const std::string& words, unsigned char level) {
    EXPECT_LT(secondsUntil([&] { return diagnoses_.complains(nodelet, words); }), kWithin_s)
        << nodelet << ": " << words << "\nbut\n"
        << diagnoses_.complaints();
    EXPECT_EQ(diagnoses_.of(nodelet).level, level) << words;
    EXPECT_LT(secondsUntil([&] { return diagnoses_.complains(kFitToDriveStatus, words); }), kWithin_s) << words;
  }

  void expectEnd(const std::string& nodelet, const std::string& words) {
    EXPECT_LT(secondsUntil([&] { return !diagnoses_.complains(nodelet, words); }), kWithin_s) << words;
  }

  void expectHealthySoon() {
    EXPECT_LT(secondsUntil([this] { return diagnoses_.complaints().empty(); }, 15.0), 15.0) << diagnoses_.complaints();
  }

  void tryFault(const Fault<sensor_msgs::Imu>& on_imu, const Fault<sensor_msgs::JointState>& on_joints,
                const std::string& nodelet, const std::string& words) {
    on_imu_ = on_imu;
    on_joints_ = on_joints;
    expectAlarm(nodelet, words, diagnostic_msgs::DiagnosticStatus::ERROR);
    on_imu_ = nullptr;
    on_joints_ = nullptr;
    expectEnd(nodelet, words);
    expectHealthySoon();
  }

  static constexpr const char* kFitToDriveStatus = "fit to drive";

  ros::NodeHandle node_;
  Config config_ = configFromParameters(node_, "slipnav");
  SimulatedSensors sensors_{config_};
  SimulatedDrive rover_{config_.simulator, Planet::byName(config_.planet)};
  ros::Publisher imu_ = node_.advertise<sensor_msgs::Imu>(config_.topics.imu, 100);
  ros::Publisher joints_ = node_.advertise<sensor_msgs::JointState>(config_.topics.joint_states, 100);
  ros::Publisher commands_ = node_.advertise<geometry_msgs::Twist>(config_.topics.cmd_vel_in, 100);
  ros::Subscriber base_;
  ros::Subscriber estimates_;
  Diagnoses diagnoses_{node_};
  Fault<sensor_msgs::Imu> on_imu_;
  Fault<sensor_msgs::JointState> on_joints_;
  double wanted_mps_ = 0.0;
  double told_mps_ = 0.0;
  bool obeys_ = true;
  int estimates_heard_ = 0;
  double due_s_ = 0.0;
  Nanoseconds newest_ = 0;
};

TEST_F(Diagnostics, NameTheCauseAndEndWithIt) {
  start();
  using Imu = sensor_msgs::Imu;
  using Joints = sensor_msgs::JointState;
  tryFault([](Imu&) { return false; }, {}, "ins", "IMU silent: nothing usable on imu/data");
  tryFault(
      [](Imu& imu) {
        imu.angular_velocity.x = imu.linear_acceleration.z = std::numeric_limits<double>::quiet_NaN();
        return true;
      },
      {}, "ins", "no usable samples of IMU: not a number or infinite");
  tryFault(
      [frozen = Imu()](Imu& imu) mutable {
        frozen.header.frame_id.empty() ? void(frozen = imu) : void();
        imu.angular_velocity = frozen.angular_velocity;
        imu.linear_acceleration = frozen.linear_acceleration;
        return true;
      },
      {}, "ins", "the IMU repeats exactly the same values");
  tryFault(
      {}, [](Joints&) { return false; }, "filter", "wheels silent: nothing usable on joint_states");
  tryFault(
      {},
      [](Joints& joints) {
        joints.name.front() = "misnamed";
        return true;
      },
      "filter", "no usable samples of wheels: joint_states has no joint");
}

/// At a start from rest, by the filter at once; told by the direction of the start afterwards.
TEST_F(Diagnostics, WheelsThatTurnBackwards) {
  start();
  wanted_mps_ = 0.0;
  goOn(4.0);
  on_joints_ = [](sensor_msgs::JointState& joints) {
    for (std::size_t i = 0; i < joints.name.size(); ++i) {
      joints.velocity[i] = -joints.velocity[i];
      joints.position[i] = -joints.position[i];
    }
    return true;
  };
  wanted_mps_ = kSpeed_mps;
  expectAlarm("filter", "wheels turn against the motion", diagnostic_msgs::DiagnosticStatus::WARN);
  on_joints_ = nullptr;
  expectEnd("filter", "wheels turn against the motion");
}

/// Nodelets of one thread report at the same time, and not only the last of them must be heard.
TEST_F(Diagnostics, NoReportIsLost) {
  constexpr std::size_t kMany = 100;
  std::set<std::uint32_t> counts;
  const boost::function<void(const diagnostic_msgs::DiagnosticArray::ConstPtr&)> count =
      [&counts](const auto& message) { counts.insert(message->header.seq); };
  const ros::Subscriber subscriber = node_.subscribe<diagnostic_msgs::DiagnosticArray>("diagnostics", 0, count);
  for (const double begin_s = now(); counts.size() < kMany && now() - begin_s < kPatience_s;) {
    ros::spinOnce();
    ros::WallDuration(0.01).sleep();
  }
  ASSERT_GE(counts.size(), kMany);
  EXPECT_EQ(*counts.rbegin() - *counts.begin() + 1, counts.size());
}

TEST_F(Diagnostics, AStopThatIsIgnored) {
  start();
  std_srvs::SetBool call;
  call.request.data = 1;
  ASSERT_TRUE(ros::service::call("stop_supervisor/emergency_stop", call));
  obeys_ = false;
  const std::string words = "the rover keeps driving although it is told to stop";
  expectAlarm("stop_supervisor", words, diagnostic_msgs::DiagnosticStatus::ERROR);
  obeys_ = true;
  expectEnd("stop_supervisor", words);
  call.request.data = 0;
  ASSERT_TRUE(ros::service::call("stop_supervisor/emergency_stop", call));
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "diagnostics");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
