/// The stop supervisor between the operator's commands and the rover, as nodes see it.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <slipnav/ErrorForecast.h>
#include <slipnav/NavState.h>
#include <slipnav/StopStatus.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ros/runtime/tuning_messages.h"

namespace slipnav {
namespace {

/// One supervisor in a namespace of its own, and everything that talks to it.
class SupervisorTest : public ::testing::Test {
 protected:
  void start(const std::string& name, const std::string& mode) {
    node_ = ros::NodeHandle(name);
    node_.setParam("slipnav/stop/mode", mode);
    node_.setParam("slipnav/checkpoint/stop_file", "none");
    loader_ = std::make_unique<nodelet::Loader>(false);
    ASSERT_TRUE(
        loader_->load(name + "/supervisor", "slipnav/StopSupervisor", nodelet::M_string(), nodelet::V_string()));
    commands_ = node_.advertise<geometry_msgs::Twist>("cmd_vel_in", 100);
    estimates_ = node_.advertise<NavState>("nav_state", 100);
    forecasts_ = node_.advertise<ErrorForecast>("error_forecast", 100);
    listen<geometry_msgs::Twist>("cmd_vel", [this](const auto& message) { executed_.push_back(message->linear.x); });
    listen<StopStatus>("stop", [this](const auto& message) { status_ = *message; });
    ASSERT_TRUE(waitUntil([this] { return estimates_.getNumSubscribers() > 0 && forecasts_.getNumSubscribers() > 0; }));
  }

  template <class Message, class Handler>
  void listen(const std::string& topic, Handler handler) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback = handler;
    subscribers_.push_back(node_.subscribe<Message>(topic, 100, callback));
  }

  /// @return whether it became true within some seconds
  template <class Condition>
  static bool waitUntil(Condition condition, double limit_s = 10.0) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    while (!condition() && (ros::SteadyTime::now() - begin).toSec() < limit_s) {
      ros::spinOnce();
      ros::WallDuration(0.005).sleep();
    }
    return condition();
  }

  /// What the rover is told when the operator commands this; NaN for nothing.
  double command(double forward_mps) {
    const std::size_t before = executed_.size();
    geometry_msgs::Twist message;
    message.linear.x = forward_mps;
    commands_.publish(message);
    return waitUntil([&] { return executed_.size() > before; }, 2.0) ? executed_.back()
                                                                     : std::numeric_limits<double>::quiet_NaN();
  }

  /// Lets time of the stamps pass.
  void observe(double duration_s) {
    for (const double end_s = time_s_ + duration_s; time_s_ < end_s;) {
      time_s_ += 0.1;
      const auto message = boost::make_shared<NavState>();
      message->header.stamp = ros::Time(time_s_);
      estimates_.publish(NavState::ConstPtr(message));
    }
    ASSERT_TRUE(waitUntil([this] { return status_.header.stamp == ros::Time(time_s_); }));
  }

  void forecast(double time_to_stop_s) {
    const auto message = boost::make_shared<ErrorForecast>();
    message->header.stamp = ros::Time(time_s_);
    message->time_to_stop_s = time_to_stop_s;
    forecasts_.publish(ErrorForecast::ConstPtr(message));
  }

  void stopTheRover() {
    observe(6.0);
    forecast(0.0);
    ASSERT_TRUE(waitUntil([this] { return status_.state == StopStatus::STOPPING; })) << status_.reason;
  }

  std::string callSwitch(const std::string& service, bool on) {
    std_srvs::SetBool call;
    call.request.data = on ? 1 : 0;
    return ros::service::call(node_.resolveName("supervisor/" + service), call) ? call.response.message : "";
  }

  void tune(const std::string& mode) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config = toValues({{"stop.mode", mode, {}, {}, ""}});
    ASSERT_TRUE(ros::service::call(node_.resolveName("supervisor/set_parameters"), call));
  }

  ros::NodeHandle node_;
  std::unique_ptr<nodelet::Loader> loader_;
  ros::Publisher commands_;
  ros::Publisher estimates_;
  ros::Publisher forecasts_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<double> executed_;
  StopStatus status_;
  double time_s_ = 1000.0;
};

TEST_F(SupervisorTest, AnActiveOneStopsTheRoverAndLetsTheOperatorStopItAtOnce) {
  start("/active", "active");
  ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() > 0; }));
  EXPECT_EQ(command(0.5), 0.5) << "before there are estimates";
  stopTheRover();
  EXPECT_EQ(command(0.5), 0.5) << "the ramp begins";
  observe(0.5);
  EXPECT_NEAR(command(0.5), 0.25, 1e-9);
  EXPECT_EQ(command(0.0), 0.0);
  EXPECT_EQ(command(0.5), 0.0);
}

TEST_F(SupervisorTest, NothingIsEmittedForAnOperatorWhoIsSilent) {
  node_.setParam("/silent/slipnav/stop/estimate_timeout_s", 60.0);
  node_.setParam("/silent/slipnav/topics/diagnostics", "health");
  start("/silent", "active");
  ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() > 0; }));
  EXPECT_EQ(command(0.5), 0.5);
  std::string diagnosis;
  listen<diagnostic_msgs::DiagnosticArray>("health", [&diagnosis](const auto& message) {
    for (const auto& status : message->status) {
      diagnosis = status.name.find("/silent/supervisor") != std::string::npos ? status.message : diagnosis;
    }
  });
  stopTheRover();
  observe(10.0);
  EXPECT_TRUE(waitUntil([&diagnosis] { return diagnosis == "cmd_vel_in is silent"; })) << diagnosis;
  EXPECT_EQ(executed_.size(), 1U);
}

TEST_F(SupervisorTest, TheOperatorsServices) {
  start("/services", "active");
  ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() > 0; }));
  std_srvs::Trigger stop;
  ASSERT_TRUE(ros::service::call("/services/supervisor/stop_now", stop));
  EXPECT_FALSE(stop.response.success);
  EXPECT_EQ(stop.response.message, "no stop: no estimates");
  observe(0.1);
  ASSERT_TRUE(ros::service::call("/services/supervisor/stop_now", stop));
  EXPECT_TRUE(stop.response.success);
  ASSERT_TRUE(waitUntil([this] { return status_.state == StopStatus::STOPPING; }));
  EXPECT_EQ(callSwitch("override", true),
            "commands pass, no stops; not kept over a restart: checkpoint.stop_file names no file");
  EXPECT_EQ(command(0.5), 0.5);
  EXPECT_EQ(callSwitch("emergency_stop", true).find("every command becomes zero: cmd_vel is heard by /stop_supervisor"),
            0U);
  ASSERT_TRUE(waitUntil([this] { return executed_.size() >= 2; })) << "not only with the next command";
  EXPECT_EQ(executed_.back(), 0.0);
  EXPECT_EQ(command(0.5), 0.0);
  EXPECT_TRUE(waitUntil([this] { return status_.emergency_stop && status_.overridden; }));
  EXPECT_EQ(callSwitch("emergency_stop", false).find("commands pass, by a ramp"), 0U);
  EXPECT_TRUE(waitUntil([this] { return command(0.5) == 0.5; }));
}

TEST_F(SupervisorTest, ACommandThatIsNotFiniteBecomesZero) {
  start("/broken", "advise");
  ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() > 0; }));
  EXPECT_EQ(command(std::numeric_limits<double>::infinity()), 0.0);
}

TEST_F(SupervisorTest, AnAdviserOnlySpeaks) {
  start("/adviser", "advise");
  ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() > 0; }));
  stopTheRover();
  observe(2.0);
  EXPECT_EQ(command(0.5), 0.5);
}

TEST_F(SupervisorTest, WithoutEstimatesAStopGoesOnWithinItsLimitAndThenCommandsPass) {
  start("/lost", "active");
  ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() > 0; }));
  stopTheRover();
  EXPECT_TRUE(waitUntil([this] { return status_.state == StopStatus::DRIVING; }, 40.0));
  EXPECT_EQ(status_.reason, "no estimates");
  EXPECT_TRUE(waitUntil([this] { return command(0.5) == 0.5; })) << "by a ramp";
}

TEST_F(SupervisorTest, OneThatIsOffKeepsItsHandsOffTheCommands) {
  start("/off", "off");
  observe(1.0);
  EXPECT_EQ(status_.mode, StopStatus::MODE_OFF);
  EXPECT_EQ(commands_.getNumSubscribers(), 0U);
  EXPECT_EQ(subscribers_.front().getNumPublishers(), 0U);
}

TEST_F(SupervisorTest, OneThatWasOffTakesItsPlaceWhenTheModeChangesAndKeepsIt) {
  start("/woken", "off");
  observe(1.0);
  tune("advise");
  ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() > 0; }));
  ASSERT_TRUE(waitUntil([this] { return subscribers_.front().getNumPublishers() > 0; }));
  EXPECT_EQ(command(0.5), 0.5);
  tune("active");
  stopTheRover();
  observe(0.5);
  EXPECT_LT(command(0.5), 0.5);
  tune("off");
  ASSERT_TRUE(waitUntil([this] { return status_.mode == StopStatus::MODE_OFF; }));
  EXPECT_EQ(status_.state, StopStatus::DRIVING);
  EXPECT_EQ(command(0.5), 0.5) << "commands do not run dry";
}

TEST_F(SupervisorTest, WhatAnotherNodeletWasToldHoldsHereAsWell) {
  start("/told", "advise");
  const ros::Publisher others = node_.advertise<dynamic_reconfigure::Config>("tuning", 1);
  ASSERT_TRUE(waitUntil([&others] { return others.getNumSubscribers() > 0; }));
  others.publish(toValues({{"stop.mode", std::string("active"), {}, {}, ""}}));
  EXPECT_TRUE(waitUntil([this] { return status_.mode == StopStatus::MODE_ACTIVE; }));
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "stop_supervisor");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
