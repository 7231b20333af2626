/// An emergency stop holds whatever happens to the process, and says so when nobody hears it.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>
#include <signal.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ros/replay/node_process.h"
#include "ros/runtime/child_process.h"
#include "ros/runtime/tuning_messages.h"

namespace slipnav {
namespace {

constexpr double kSpeed_mps = 0.8;
constexpr double kPatience_s = 20.0;

/// One supervisor in a process of its own, an operator who drives on all the time, and a base.
class EmergencyStop : public ::testing::Test {
 protected:
  ~EmergencyStop() override {
    process_.reset();
    std::filesystem::remove(file_);
  }

  void start(const std::string& name, const std::string& mode) {
    name_ = name;
    mode_ = mode;
    node_ = ros::NodeHandle(name);
    file_ = std::filesystem::temp_directory_path() / ("slipnav" + std::to_string(getpid()) + name.substr(1) + ".stop");
    commands_ = node_.advertise<geometry_msgs::Twist>("cmd_vel_in", 10);
    listen<std_msgs::Float64>("stop_cmd", [this](const auto& message) { countdown_s_ = message->data; });
    listen<diagnostic_msgs::DiagnosticArray>("health", [this](const auto& message) {
      diagnosis_ = message->status.front().message;
      level_ = message->status.front().level;
    });
    launch();
  }

  void listenAsBase() {
    base_ = node_.subscribe<geometry_msgs::Twist>(
        "cmd_vel", 100, boost::function<void(const geometry_msgs::Twist::ConstPtr&)>([this](const auto& message) {
          executed_.push_back(message->linear.x);
        }));
  }

  void listenAsMultiplexer() {
    lock_listener_ = node_.subscribe<std_msgs::Bool>("e_stop", 10,
                                                     boost::function<void(const std_msgs::Bool::ConstPtr&)>(
                                                         [this](const auto& message) { lock_ = message->data != 0; }));
  }

  /// Nothing is left of the one before but the file.
  void launch() {
    node_.deleteParam("slipnav");
    node_.setParam("slipnav/stop/mode", mode_);
    node_.setParam("slipnav/checkpoint/stop_file", file_);
    node_.setParam("slipnav/topics/diagnostics", "health");
    process_ = std::make_unique<ChildProcess>(std::vector<std::string>{
        packageExecutable("manager"), "supervisor=slipnav/StopSupervisor", "__name:=manager", "__ns:=" + name_});
    ASSERT_TRUE(waitUntil([this] { return ros::service::exists(service("emergency_stop"), false); }));
  }

  void end(int signal) {
    ASSERT_EQ(kill(pidOf(name_ + "/manager"), signal), 0);
    process_->wait();
    ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() == 0; }));
  }

  /// Within the running manager.
  void reload() {
    nodelet::NodeletUnload unload;
    unload.request.name = name_ + "/supervisor";
    ASSERT_TRUE(ros::service::call(name_ + "/manager/unload_nodelet", unload) && unload.response.success);
    ASSERT_TRUE(waitUntil([this] { return commands_.getNumSubscribers() == 0; }));
    nodelet::NodeletLoad load;
    load.request.name = unload.request.name;
    load.request.type = "slipnav/StopSupervisor";
    ASSERT_TRUE(ros::service::call(name_ + "/manager/load_nodelet", load) && load.response.success);
  }

  std::string service(const std::string& name) const { return name_ + "/supervisor/" + name; }

  std_srvs::SetBoolResponse call(const std::string& name, bool on) {
    std_srvs::SetBool call;
    call.request.data = on ? 1 : 0;
    EXPECT_TRUE(ros::service::call(service(name), call));
    return call.response;
  }

  void tune(const std::string& mode) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config = toValues({{"stop.mode", mode, {}, {}, ""}});
    ASSERT_TRUE(ros::service::call(service("set_parameters"), call));
  }

  template <class Message, class Handler>
  void listen(const std::string& topic, Handler handler) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback = handler;
    subscribers_.push_back(node_.subscribe<Message>(topic, 100, callback));
  }

  /// Meanwhile the operator drives on.
  template <class Condition>
  bool waitUntil(Condition condition, double limit_s = kPatience_s) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    while (!condition() && (ros::SteadyTime::now() - begin).toSec() < limit_s) {
      geometry_msgs::Twist message;
      message.linear.x = kSpeed_mps;
      commands_.publish(message);
      ros::WallDuration(0.02).sleep();
      ros::spinOnce();
    }
    return condition();
  }

  void expectOnlyZeros() {
    executed_.clear();
    EXPECT_TRUE(waitUntil([this] { return executed_.size() > 20; }));
    EXPECT_EQ(std::count(executed_.begin(), executed_.end(), 0.0), static_cast<long>(executed_.size()));
  }

  void expectStopUntilReleased() {
    listenAsBase();
    ASSERT_TRUE(waitUntil([this] { return base_.getNumPublishers() > 0 || mode_ == "off"; }));
    const std_srvs::SetBoolResponse answer = call("emergency_stop", true);
    EXPECT_EQ(answer.success != 0, mode_ == "active") << answer.message;
    EXPECT_TRUE(std::filesystem::exists(file_)) << "before the answer";
    expectOnlyZeros();
    expectItHolds();
    EXPECT_EQ(countdown_s_, 0.0);
    EXPECT_EQ(call("emergency_stop", false).success, 1);
    EXPECT_TRUE(waitUntil([this] { return executed_.back() == kSpeed_mps; }));
    end(SIGKILL);
    launch();
    EXPECT_TRUE(waitUntil([this] { return !executed_.empty() && executed_.back() == kSpeed_mps; }))
        << "released for good";
  }

  /// Over restarts of both kinds and a reload, and whatever mode is chosen.
  void expectItHolds() {
    for (const int signal : {SIGKILL, SIGINT}) {
      end(signal);
      launch();
      expectOnlyZeros();
    }
    reload();
    expectOnlyZeros();
    for (const char* mode : {"off", "active", "advise"}) {
      tune(mode);
      expectOnlyZeros();
    }
  }

  std::string name_;
  std::string mode_;
  std::string file_;
  ros::NodeHandle node_;
  std::unique_ptr<ChildProcess> process_;
  ros::Publisher commands_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber base_;
  ros::Subscriber lock_listener_;
  std::vector<double> executed_;
  std::optional<bool> lock_;
  double countdown_s_ = -1.0;
  std::string diagnosis_;
  int level_ = -1;
};

TEST_F(EmergencyStop, HoldsOverEveryRestartInActive) {
  start("/active", "active");
  expectStopUntilReleased();
}

TEST_F(EmergencyStop, HoldsOverEveryRestartInAdvise) {
  start("/advise", "advise");
  expectStopUntilReleased();
}

/// The released one steps aside again.
TEST_F(EmergencyStop, HoldsOverEveryRestartInOff) {
  start("/off", "off");
  EXPECT_FALSE(call("emergency_stop", true).success);
  listenAsBase();
  expectOnlyZeros();
  expectItHolds();
  EXPECT_TRUE(call("emergency_stop", false).success);
}

TEST_F(EmergencyStop, IsNotCalledAStopWhereNobodyListens) {
  start("/unheard", "active");
  const std_srvs::SetBoolResponse answer = call("emergency_stop", true);
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(answer.message.find("no stop: nobody listens to cmd_vel or e_stop"), 0U) << answer.message;
  const std::string unheard = "emergency stop without effect: nobody listens to cmd_vel or e_stop";
  EXPECT_TRUE(waitUntil([&] { return diagnosis_ == unheard && level_ == 2; })) << diagnosis_;
  EXPECT_TRUE(waitUntil([&] { return countdown_s_ == 0.0; })) << "what the legacy stack takes for a stop";
  listenAsBase();
  EXPECT_TRUE(waitUntil([&] { return diagnosis_ == "emergency stop" && level_ == 1; })) << diagnosis_;
  base_.shutdown();
  EXPECT_TRUE(waitUntil([&] { return diagnosis_ == unheard && level_ == 2; })) << "a listener that is lost";
}

TEST_F(EmergencyStop, IsAStopInAdviseWhereAMultiplexerTakesTheLock) {
  start("/locked", "advise");
  listenAsMultiplexer();
  ASSERT_TRUE(waitUntil([this] { return lock_listener_.getNumPublishers() > 0; }));
  const std_srvs::SetBoolResponse answer = call("emergency_stop", true);
  EXPECT_TRUE(answer.success) << answer.message;
  EXPECT_NE(answer.message.find("e_stop by /emergency_stop"), std::string::npos) << answer.message;
  EXPECT_TRUE(waitUntil([this] { return lock_ == true; }));
  end(SIGKILL);
  lock_.reset();
  launch();
  EXPECT_TRUE(waitUntil([this] { return lock_ == true; })) << "said again by the next process";
  EXPECT_TRUE(call("emergency_stop", false).success);
  EXPECT_TRUE(waitUntil([this] { return lock_ == false; }));
}

TEST_F(EmergencyStop, AnOverrideHoldsAsWell) {
  start("/override", "active");
  listenAsBase();
  EXPECT_TRUE(call("override", true).success);
  end(SIGKILL);
  launch();
  std_srvs::Trigger stop;
  ASSERT_TRUE(ros::service::call(service("stop_now"), stop));
  EXPECT_FALSE(stop.response.success);
}

TEST_F(EmergencyStop, AStopThatNobodyHearsIsRefused) {
  start("/deaf", "active");
  std_srvs::Trigger stop;
  ASSERT_TRUE(ros::service::call(service("stop_now"), stop));
  EXPECT_EQ(stop.response.message, "no stop: nobody listens to cmd_vel");
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "emergency_stop");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
