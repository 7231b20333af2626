/// slipnav/SimulatedRover: a virtual rover for operators to drive. In real time, by the ROS
/// clock; like real bases, it executes its last command for one second. To the nodelets it is a rover like any other.
///
/// In: cmd_vel. Out: imu/data, joint_states, gps/fix, truth/fix, truth/odometry.

#include <geometry_msgs/Twist.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <memory>

#include "evaluation/simulated_drive.h"
#include "ros/messages/conversions.h"
#include "ros/messages/stop_messages.h"
#include "ros/runtime/nodelet_base.h"
#include "ros/simulation/sensor_publisher.h"

namespace slipnav {

namespace {

/// [s] after which a command expires: nobody is driving.
constexpr double kCommandLifetime_s = 1.0;
/// A machine that was busy for longer than this catches up no further [s]: the rover has stood still meanwhile.
constexpr double kMostBehind_s = 1.0;

}  // namespace

class SimulatedRoverNodelet : public NodeletBase {
 public:
  ~SimulatedRoverNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    sim::SimulatorParams params = config.simulator;
    params.start_time_s = ros::Time::now().toSec();
    rover_ = std::make_unique<sim::RoverSimulator>(params, Planet::byName(config.planet));
    behind_since_s_ = now();
  }

  bool needsExtrinsics() const override { return false; }

  void subscribe(const Config& config) override {
    listen<geometry_msgs::Twist>(config.topics.cmd_vel, &SimulatedRoverNodelet::onCommand);
  }

  void advertise(const Config& config) override {
    sensors_ = std::make_unique<SensorPublisher>(node(), config, SensorPublisher::Clock::kNone);
  }

  void onCommand(const geometry_msgs::Twist::ConstPtr& message) {
    const VelocityCommand in_users_axes = toVelocityCommand(*message);
    if (in_users_axes.isFinite()) {
      command_ = {swapFrdFlu(in_users_axes.linear_mps), swapFrdFlu(in_users_axes.angular_radps)};
      commanded_s_ = now();
    }
  }

  double tickInterval_s() const override { return 0.01; }
  void onTick() override {
    const double now_s = now();
    due_s_ = std::min(due_s_ + now_s - behind_since_s_, kMostBehind_s);
    behind_since_s_ = now_s;
    while (due_s_ > 0.0) {
      const Nanoseconds before = rover_->truth().stamp;
      const bool is_told = now_s - commanded_s_ < kCommandLifetime_s;
      const sim::Measurements measurements =
          rover_->step(is_told ? sim::Command{command_.linear_mps.x(), command_.angular_radps.z()} : sim::Command{});
      sensors_->publish(measurements, rover_->truth());
      due_s_ -= toSeconds(rover_->truth().stamp - before);
    }
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const bool is_told = now() - commanded_s_ < kCommandLifetime_s;
    status.summary(DiagnosticStatus::OK, is_told ? "obeying" : "waiting for commands");
    if (rover_) {
      status.addf("distance [m]", "%.1f", rover_->truth().distance_m);
    }
  }

  std::unique_ptr<sim::RoverSimulator> rover_;
  std::unique_ptr<SensorPublisher> sensors_;
  VelocityCommand command_;
  double commanded_s_ = -2.0 * kCommandLifetime_s;
  double due_s_ = 0.0;  ///< to be simulated
  double behind_since_s_ = 0.0;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::SimulatedRoverNodelet, nodelet::Nodelet)
