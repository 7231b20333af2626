/// Each nodelet in turn is unloaded while the rover drives, and reloaded a moment later: the estimate continues, and
/// its covariance covers what was missed.

#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <slipnav/ErrorForecast.h>
#include <slipnav/Initialization.h>
#include <slipnav/StopStatus.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "evaluation/simulated_drive.h"
#include "ros/messages/conversions.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/parameters.h"
#include "ros/simulation/sensor_publisher.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav {
namespace {

constexpr double kRate = 5.0;            // on real time
constexpr double kFirstUnload_s = 30.0;  // of the drive: there are forecasts
constexpr double kBetween_s = 14.0;
constexpr double kAway_s = 1.0;
/// After each reload the rover stands still for a while, as it does when it heeds the supervisor.
constexpr double kRestAfter_s = 5.0;
constexpr double kRest_s = 3.0;
constexpr double kLongestGap_s = 6.0;  // about a second of real time
const std::array<std::string, 6> kNodelets = {"Ins", "Filter", "Initializer", "Forecast", "StopSupervisor", "Overlay"};

/// One axis of one estimate against the truth.
struct Error {
  double error_m;
  double std_m;
};

class ReloadNodelets : public ::testing::Test {
 protected:
  ReloadNodelets() {
    for (const std::string& name : kNodelets) {
      load(name);
    }
    note<ErrorForecast>(config_.topics.error_forecast);
    note<StopStatus>(config_.topics.stop);
    note<nav_msgs::Path>(config_.topics.path);
    listen<Initialization>(kInitializationTopic, [this](const Initialization& message) {
      if (message.done) {
        const Geodetic origin{degToRad(message.latitude_deg), degToRad(message.longitude_deg), message.height_m};
        frame_.emplace(planet_, origin);
      }
    });
    listen<nav_msgs::Odometry>(config_.topics.odometry,
                               [this](const nav_msgs::Odometry& message) { compare(message); });
  }

  void load(const std::string& name) {
    ASSERT_TRUE(loader_.load("/" + name, "slipnav/" + name, nodelet::M_string(), nodelet::V_string()));
  }
  void unload(const std::string& name) { ASSERT_TRUE(loader_.unload("/" + name)); }

  template <class Message>
  void listen(const std::string& topic, const std::function<void(const Message&)>& handler) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [handler](const boost::shared_ptr<const Message>& message) { handler(*message); };
    subscribers_.push_back(node_.subscribe<Message>(topic, 0, callback));
  }

  template <class Message>
  void note(const std::string& topic) {
    listen<Message>(topic, [this, topic](const Message& message) { newest_[topic] = message.header.stamp.toSec(); });
  }

  void compare(const nav_msgs::Odometry& estimate) {
    stamps_.push_back(estimate.header.stamp.toSec());
    const auto truth = truth_.find(toNanoseconds(estimate.header.stamp));
    ASSERT_TRUE(frame_.has_value());
    ASSERT_NE(truth, truth_.end());
    const geometry_msgs::Point& p = estimate.pose.pose.position;
    const Vector3 error = Vector3(p.x, p.y, p.z) - frame_->toEnu(truth->second);
    ASSERT_TRUE(error.allFinite());
    ASSERT_TRUE(std::all_of(estimate.pose.covariance.begin(), estimate.pose.covariance.end(),
                            [](double value) { return std::isfinite(value); }));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      errors_.push_back(
          {std::abs(error[static_cast<Eigen::Index>(axis)]), std::sqrt(estimate.pose.covariance[7 * axis])});
    }
  }

  static bool isRest(double t_s) {
    return t_s > kFirstUnload_s && std::abs(std::fmod(t_s - kFirstUnload_s, kBetween_s) - kRestAfter_s) < 0.5 * kRest_s;
  }

  /// Drives for `duration_s`, with `moment` called after each interval with the time since the beginning.
  void drive(double duration_s, const std::function<void(double)>& moment) {
    SimulatedDrive rover(config_.simulator, planet_);
    const Nanoseconds start = rover.truth().stamp;
    const ros::SteadyTime begin = ros::SteadyTime::now();
    for (double t_s = 0.0; t_s < duration_s && !rover.finished(); t_s = toSeconds(rover.truth().stamp - start)) {
      const VelocityCommand command = rover.operatorCommand();
      const sim::Measurements measured = rover.execute(isRest(t_s) ? VelocityCommand{} : command);
      truth_[rover.truth().stamp] = rover.truth().position;
      sensors_.publish(measured, rover.truth());
      moment(t_s);
      do {
        ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.001));
      } while ((ros::SteadyTime::now() - begin).toSec() < t_s / kRate);
    }
  }

  void expectEstimatesGoOn() const {
    const double end_s = toSeconds(truth_.rbegin()->first);
    ASSERT_GT(stamps_.size(), 100U);
    for (std::size_t i = 1; i < stamps_.size(); ++i) {
      EXPECT_LT(stamps_[i] - stamps_[i - 1], kLongestGap_s) << "at " << stamps_[i];
    }
    EXPECT_LT(end_s - stamps_.back(), kLongestGap_s);
  }

  void expectErrorsAreCovered() const {
    const auto covered = std::count_if(errors_.begin(), errors_.end(),
                                       [](const Error& error) { return error.error_m < 3.0 * error.std_m; });
    EXPECT_GT(static_cast<double>(covered), 0.99 * static_cast<double>(errors_.size()));
    const auto largest = std::max_element(errors_.begin(), errors_.end(),
                                          [](const Error& a, const Error& b) { return a.error_m < b.error_m; });
    RecordProperty("largest_error_m", std::to_string(largest->error_m));
    EXPECT_LT(largest->std_m, 10.0);
  }

  ros::NodeHandle node_;
  Config config_ = configFromParameters(node_, "slipnav");
  Planet planet_ = Planet::byName(config_.planet);
  nodelet::Loader loader_{false};
  SensorPublisher sensors_{node_, config_};
  std::vector<ros::Subscriber> subscribers_;
  std::map<Nanoseconds, Geodetic> truth_;
  std::optional<LocalFrame> frame_;
  std::vector<double> stamps_;
  std::vector<Error> errors_;
  std::map<std::string, double> newest_;  ///< stamps by topic
};

TEST_F(ReloadNodelets, TheEstimateGoesOn) {
  std::size_t unloaded = 0;
  std::size_t loaded = 0;
  const double duration_s = kFirstUnload_s + kBetween_s * static_cast<double>(kNodelets.size());
  drive(duration_s, [this, &unloaded, &loaded](double t_s) {
    const auto due = [t_s](std::size_t done, double delay_s) {
      return done < kNodelets.size() && t_s >= kFirstUnload_s + kBetween_s * static_cast<double>(done) + delay_s;
    };
    if (due(unloaded, 0.0)) {
      unload(kNodelets.at(unloaded++));
    }
    if (due(loaded, kAway_s)) {
      load(kNodelets.at(loaded++));
    }
  });
  ASSERT_EQ(loaded, kNodelets.size());
  expectEstimatesGoOn();
  expectErrorsAreCovered();
  ASSERT_EQ(newest_.size(), 3U);
  for (const auto& [topic, stamp_s] : newest_) {
    EXPECT_LT(stamps_.back() - stamp_s, kLongestGap_s) << topic;
  }
}

/// After a clock that has gone back, a reloaded nodelet knows nothing of earlier sessions.
TEST_F(ReloadNodelets, InTheSecondSessionAsWell) {
  drive(kFirstUnload_s, [](double) {});
  stamps_.clear();
  bool away = false;
  bool back = false;
  drive(kFirstUnload_s + 2.0 * kBetween_s, [this, &away, &back](double t_s) {
    if (!away && t_s > kFirstUnload_s) {
      unload("Ins");
      away = true;
    }
    if (!back && t_s > kFirstUnload_s + kAway_s) {
      load("Ins");
      back = true;
    }
  });
  EXPECT_LT(toSeconds(truth_.rbegin()->first) - stamps_.back(), kLongestGap_s);
  expectErrorsAreCovered();
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "reload_nodelets");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
