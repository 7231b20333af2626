/// A fake of the paper's own software against `rover.launch config:=pathfinder`, both directions: its sensors and its
/// operator are served, its node that counts down to a stop and holds, its multiplexer with a lock, its listeners.

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <slipnav/Initialization.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/simulated_drive.h"
#include "ros/messages/conversions.h"
#include "ros/runtime/parameters.h"
#include "ros/simulation/sensor_publisher.h"

namespace slipnav {
namespace {

constexpr double kRate = 5.0;       // on real time
constexpr double kDrive_s = 120.0;  // at most
constexpr double kTolerance = 1e-9;

/// The legacy rover's driver: it counts down to a stop, holds for five seconds, and resumes. Every message sets the
/// countdown, except during a hold.
class LegacyDriver {
 public:
  void hear(double seconds) {
    ++messages_;
    finite_ = finite_ && std::isfinite(seconds);
    if (hold_s_ <= 0.0) {
      countdown_s_ = seconds;
    }
  }

  /// @return whether it drives in the next `interval_s`
  bool drives(double interval_s) {
    if (hold_s_ > 0.0) {
      hold_s_ -= interval_s;
      return hold_s_ <= 0.0;
    }
    countdown_s_ -= interval_s;
    if (countdown_s_ > 0.0) {
      return true;
    }
    hold_s_ = 5.0;
    countdown_s_ = 1e9;
    ++stops_;
    return false;
  }

  int stops() const { return stops_; }
  int messages() const { return messages_; }
  bool hasHeardFiniteOnly() const { return finite_; }

 private:
  double countdown_s_ = 1e9;
  double hold_s_ = 0.0;
  int stops_ = 0;
  int messages_ = 0;
  bool finite_ = true;
};

using Values = std::vector<double>;

Values valuesOf(const geometry_msgs::PointStamped& message) {
  EXPECT_EQ(message.header.frame_id, "odom");
  return {message.point.x, message.point.y, message.point.z};
}

Values valuesOf(const nav_msgs::Odometry& message) {
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "imu_link");
  const geometry_msgs::Point& p = message.pose.pose.position;
  const geometry_msgs::Vector3& v = message.twist.twist.linear;
  return {p.x, p.y, p.z, v.x, v.y, v.z};
}

/// Not with the formula of the bridge: by the parametric latitude, whose point on the ellipsoid is moved up by the
/// height. In more digits than a double has, since a double has steps of 0.93e-9 m there.
Values ecefOf(const NavState& s) {
  constexpr long double kA = 6378137.0L;
  constexpr long double kB = kA * (1.0L - 1.0L / 298.257223563L);
  const long double radian = std::acos(-1.0L) / 180.0L;
  const long double latitude = s.latitude_deg * radian;
  const long double longitude = s.longitude_deg * radian;
  const long double parametric = std::atan2(kB * std::sin(latitude), kA * std::cos(latitude));
  const long double to_axis = kA * std::cos(parametric) + s.height_m * std::cos(latitude);
  return {static_cast<double>(to_axis * std::cos(longitude)), static_cast<double>(to_axis * std::sin(longitude)),
          static_cast<double>(kB * std::sin(parametric) + s.height_m * std::sin(latitude))};
}

Values attitudeOf(const NavState& s) {
  const tf2::Quaternion q(s.orientation.x, s.orientation.y, s.orientation.z, s.orientation.w);
  double roll = 0.0;
  double pitch = 0.0;
  double yaw = 0.0;
  tf2::Matrix3x3(q).getRPY(roll, pitch, yaw);
  return {roll, -pitch, std::remainder(0.5 * kPi - yaw, 2.0 * kPi)};
}

class LegacyStack : public ::testing::Test {
 protected:
  LegacyStack() {
    listen<std_msgs::Float64>("core_nav/core_nav/stop_cmd", [this](const auto& m) { driver_.hear(m.data); });
    listen<std_msgs::Bool>("e_stop", [this](const auto& m) { locked_ = m.data != 0; });
    listen<Initialization>("initialization", [this](const auto& m) { started_ = m.done != 0; });
    listen<NavState>("nav_state", [this](const auto& m) { states_[m.header.stamp] = m; });
    listen<Slip>("slip", [this](const auto& m) { slips_[m.header.stamp] = m; });
    for (const char* name : {"position", "llh", "ecef", "enu", "velocity", "attitude", "slip"}) {
      note<geometry_msgs::PointStamped>(name);
    }
    note<nav_msgs::Odometry>("cn_odom");
  }

  template <class Message>
  void listen(const std::string& topic, const std::function<void(const Message&)>& handler) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [handler](const boost::shared_ptr<const Message>& message) { handler(*message); };
    subscribers_.push_back(node_.subscribe<Message>(topic, 0, callback));
  }

  template <class Message>
  void note(const std::string& name) {
    listen<Message>("core_nav/core_nav/" + name,
                    [this, name](const Message& m) { heard_[name][m.header.stamp] = valuesOf(m); });
  }

  static void spin() { ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.001)); }

  bool waitUntil(const std::function<bool()>& condition) const {
    for (const ros::SteadyTime begin = ros::SteadyTime::now();
         !condition() && (ros::SteadyTime::now() - begin).toSec() < 30.0;) {
      spin();
    }
    return condition();
  }

  /// Everything is there, the bridge last.
  bool isReady() const {
    return sensors_.areHeard() && std::all_of(subscribers_.begin(), subscribers_.end(),
                                              [](const ros::Subscriber& s) { return s.getNumPublishers() > 0; });
  }

  bool callEmergencyStop(bool on) {
    std_srvs::SetBool call;
    call.request.data = on ? 1 : 0;
    return ros::service::call("stop_supervisor/emergency_stop", call) && call.response.success != 0;
  }

  /// The operator drives once there is a start; before, the script of the initial drive does. Ends with `done`.
  void drive(SimulatedDrive& rover, const std::function<bool(double)>& done) {
    const Nanoseconds start = rover.truth().stamp;
    const ros::SteadyTime begin = ros::SteadyTime::now();
    Nanoseconds last = start;
    for (double t_s = 0.0; t_s < kDrive_s && !done(t_s); t_s = toSeconds(rover.truth().stamp - start)) {
      const double interval_s = toSeconds(rover.truth().stamp - last);
      last = rover.truth().stamp;
      const VelocityCommand wanted = rover.operatorCommand();
      const bool drives = !started_ || driver_.drives(interval_s);
      const VelocityCommand command = drives && !locked_ ? wanted : VelocityCommand{};
      geometry_msgs::Twist twist;
      twist.linear.x = command.linear_mps.x();
      commands_.publish(twist);
      const sim::Measurements measured = rover.execute(command);
      sensors_.publish(measured, rover.truth());
      do {
        spin();
      } while ((ros::SteadyTime::now() - begin).toSec() < t_s / kRate);
    }
  }

  void expectSame(const std::string& name, const std::function<Values(const NavState&)>& expected) {
    const std::map<ros::Time, Values>& heard = heard_[name];
    EXPECT_GT(heard.size(), 100U) << name;
    std::size_t compared = 0;
    for (const auto& [stamp, values] : heard) {
      if (states_.count(stamp) == 0) {
        continue;  // a busy machine loses one of the two now and then
      }
      ++compared;
      const Values wanted = expected(states_.at(stamp));
      ASSERT_EQ(values.size(), wanted.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_NEAR(values[i], wanted[i], kTolerance) << name << " " << i << " at " << stamp;
      }
    }
    EXPECT_GE(compared, heard.size() - heard.size() / 10) << name;
  }

  void expectSlip() {
    ASSERT_GT(heard_["slip"].size(), 100U);
    std::size_t compared = 0;
    for (const auto& [stamp, values] : heard_["slip"]) {
      if (slips_.count(stamp) == 0) {
        continue;
      }
      ++compared;
      const Slip& slip = slips_.at(stamp);
      EXPECT_EQ(values[1], 0.5 * (slip.wheel_speed_mps[2] + slip.wheel_speed_mps[3]));
      EXPECT_EQ(values[2], slip.forward_speed_mps);
      EXPECT_TRUE(values[0] == 0.0 || std::count(slip.ratio.begin(), slip.ratio.end(), values[0]) > 0);
    }
    EXPECT_GE(compared, heard_["slip"].size() - heard_["slip"].size() / 10);
  }

  ros::NodeHandle node_;
  Config config_ = configFromParameters(node_, "slipnav");
  SensorPublisher sensors_{node_, config_};
  ros::Publisher commands_ = node_.advertise<geometry_msgs::Twist>("cmd_vel_out", 100);
  std::vector<ros::Subscriber> subscribers_;
  LegacyDriver driver_;
  bool locked_ = false;
  bool started_ = false;
  std::map<ros::Time, NavState> states_;
  std::map<ros::Time, Slip> slips_;
  std::map<std::string, std::map<ros::Time, Values>> heard_;
};

TEST_F(LegacyStack, IsServedWhole) {
  ASSERT_TRUE(waitUntil([this] { return isReady(); }));
  SimulatedDrive rover(config_.simulator, Planet::byName(config_.planet));
  std::optional<double> emergency_s;
  drive(rover, [this, &emergency_s](double t_s) {
    if (!emergency_s && driver_.stops() >= 2) {
      EXPECT_TRUE(callEmergencyStop(true)) << "the multiplexer has taken the lock";
      emergency_s = t_s;
    }
    return emergency_s && t_s > *emergency_s + 4.0;
  });
  ASSERT_TRUE(started_) << "by the receiver's fix";
  EXPECT_GE(driver_.stops(), 2) << "drive, stop by countdown, hold, go on";
  EXPECT_TRUE(driver_.hasHeardFiniteOnly());
  ASSERT_TRUE(emergency_s.has_value());
  EXPECT_TRUE(locked_);
  EXPECT_LT(std::abs(states_.rbegin()->second.velocity.x), 0.05);
  EXPECT_LT(std::abs(states_.rbegin()->second.velocity.y), 0.05);
  EXPECT_TRUE(callEmergencyStop(false));
  EXPECT_TRUE(waitUntil([this] { return !locked_; }));
  EXPECT_GT(std::count_if(states_.begin(), states_.end(),
                          [](const auto& state) { return state.second.status == NavState::STATUS_STATIONARY; }),
            50)
      << "the holds are standstills";

  expectSame("position", [](const NavState& s) {
    return Values{degToRad(s.latitude_deg), degToRad(s.longitude_deg), s.height_m};
  });
  expectSame("llh", [](const NavState& s) { return Values{s.latitude_deg, s.longitude_deg, s.height_m}; });
  expectSame("ecef", ecefOf);
  expectSame("enu", [](const NavState& s) { return Values{s.position.x, s.position.y, s.position.z}; });
  expectSame("velocity", [](const NavState& s) { return Values{s.velocity.y, s.velocity.x, -s.velocity.z}; });
  expectSame("attitude", attitudeOf);
  expectSame("cn_odom", [](const NavState& s) {
    return Values{s.position.y, -s.position.x, -s.position.z, s.velocity.y, -s.velocity.x, s.velocity.z};
  });
  expectSlip();
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "legacy_stack");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
