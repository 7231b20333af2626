/// Two rovers under one master: each has its own transforms, and nobody warns.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "evaluation/simulated_drive.h"
#include "ros/runtime/parameters.h"
#include "ros/simulation/sensor_publisher.h"

namespace slipnav {
namespace {

constexpr double kRate = 5.0;  // on real time
constexpr double kDrive_s = 60.0;
constexpr double kUnderWay_s = 35.0;  // from then on there is no reason for warnings

/// One of them, and what is heard of it.
struct Rover {
  explicit Rover(const std::string& name, int seed)
      : node(name), config(configFromParameters(node, name + "/slipnav")) {
    sim::SimulatorParams params = config.simulator;
    params.seed = seed;
    params.drive.initial_rest_s = 8.0;
    drive = std::make_unique<SimulatedDrive>(params, Planet::byName(config.planet));
    sensors = std::make_unique<SensorPublisher>(node, config);
    const boost::function<void(const nav_msgs::Odometry::ConstPtr&)> note = [this](const auto& message) {
      ++estimates;
      frames = {message->header.frame_id, message->child_frame_id};
    };
    odometry = node.subscribe<nav_msgs::Odometry>(config.topics.odometry, 100, note);
  }

  void advance() { sensors->publish(drive->execute(drive->operatorCommand()), drive->truth()); }

  ros::NodeHandle node;
  Config config;
  std::unique_ptr<SimulatedDrive> drive;
  std::unique_ptr<SensorPublisher> sensors;
  ros::Subscriber odometry;
  int estimates = 0;
  std::vector<std::string> frames;
};

class TwoRovers : public ::testing::Test {
 protected:
  TwoRovers() {
    listen<tf2_msgs::TFMessage>("/tf", [this](const auto& message) { noteTransforms(*message); });
    listen<tf2_msgs::TFMessage>("/tf_static", [this](const auto& message) { noteTransforms(*message); });
    for (const char* topic : {"/a/diagnostics", "/b/diagnostics"}) {
      listen<diagnostic_msgs::DiagnosticArray>(topic, [this](const auto& message) {
        for (const auto& status : message->status) {
          if (under_way && status.level != diagnostic_msgs::DiagnosticStatus::OK) {
            complaints.insert(status.name + ": " + status.message);
          }
        }
      });
    }
    listen<rosgraph_msgs::Log>("/rosout_agg", [this](const auto& message) {
      if (under_way && message->level >= rosgraph_msgs::Log::WARN) {
        complaints.insert(message->name + ": " + message->msg);
      }
    });
  }

  template <class Message, class Handler>
  void listen(const std::string& topic, Handler handler) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback = handler;
    subscribers.push_back(ros::NodeHandle().subscribe<Message>(topic, 0, callback));
  }

  void noteTransforms(const tf2_msgs::TFMessage& message) {
    for (const auto& transform : message.transforms) {
      tree.insert(transform.header.frame_id + " -> " + transform.child_frame_id);
    }
  }

  static void spin() { ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.001)); }

  std::vector<ros::Subscriber> subscribers;
  std::set<std::string> tree;
  bool under_way = false;  ///< both have started, some seconds ago
  std::set<std::string> complaints;
};

TEST_F(TwoRovers, HaveTreesOfTheirOwn) {
  Rover a("/a", 1);
  Rover b("/b", 2);
  const ros::SteadyTime start = ros::SteadyTime::now();
  while (!(a.odometry.getNumPublishers() > 0 && b.odometry.getNumPublishers() > 0) &&
         (ros::SteadyTime::now() - start).toSec() < 30.0) {
    spin();
  }
  const ros::SteadyTime begin = ros::SteadyTime::now();
  const Nanoseconds first = a.drive->truth().stamp;
  for (double t_s = 0.0; t_s < kDrive_s; t_s = toSeconds(a.drive->truth().stamp - first)) {
    a.advance();
    b.advance();
    under_way = t_s > kUnderWay_s;
    do {
      spin();
    } while ((ros::SteadyTime::now() - begin).toSec() < t_s / kRate);
  }
  EXPECT_GT(a.estimates, 500);
  EXPECT_GT(b.estimates, 500);
  EXPECT_EQ(a.frames, (std::vector<std::string>{"a/odom", "a/base_link"}));
  EXPECT_EQ(b.frames, (std::vector<std::string>{"b/odom", "b/base_link"}));
  EXPECT_EQ(tree, (std::set<std::string>{"a/map -> a/odom", "a/odom -> a/base_link", "a/odom -> a/overlay",
                                         "b/map -> b/odom", "b/odom -> b/base_link", "b/odom -> b/overlay"}));
  EXPECT_TRUE(complaints.empty()) << *complaints.begin();
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "two_rovers");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
