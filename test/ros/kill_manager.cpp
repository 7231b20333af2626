/// The manager is killed while the rover drives: roslaunch starts it again, and the estimate goes on from the
/// checkpoint.

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "ros/simulated_bag.h"
#include "slipnav/navigator/checkpoint.h"
#include "slipnav/ros/bag_evaluation.h"
#include "slipnav/ros/parameters.h"
#include "slipnav/ros/replay_session.h"

namespace slipnav {
namespace {

constexpr double kDriveRate = 1.0;
constexpr double kKillAfter_s = 12.0;      // of the recording: the rover is driving
constexpr double kLongestRestart_s = 2.0;  // from the restart to the first estimate
constexpr double kNoticed_s =
    5.0;  // loaders miss the heartbeat of their manager for 4 s before they see that it is gone
constexpr double kFastest_mps = 0.8;

pid_t pidOf(const std::string& node) {
  std::string host;
  std::uint32_t port = 0;
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, false) ||
      !ros::network::splitURI(static_cast<std::string>(uri), host, port)) {
    return 0;
  }
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue caller;
  XmlRpc::XmlRpcValue answer;
  caller[0] = ros::this_node::getName();
  return client.execute("getPid", caller, answer) ? static_cast<int>(answer[2]) : 0;
}

/// Every estimate with the time at which it came.
struct Arrival {
  ros::SteadyTime time;
  nav_msgs::Odometry::ConstPtr message;
};

class KillManager : public ::testing::Test {
 protected:
  KillManager() {
    const boost::function<void(const nav_msgs::Odometry::ConstPtr&)> note =
        [this](const nav_msgs::Odometry::ConstPtr& message) {
          arrivals_.push_back({ros::SteadyTime::now(), message});
        };
    listener_ = node_.subscribe<nav_msgs::Odometry>(config_.topics.odometry, 0, note);
  }

  ~KillManager() override { deleteCheckpoint(config_.checkpoint.file); }

  /// A short rest, then driving straight ahead all the time.
  void writeDrive() const {
    sim::SimulatorParams params = config_.simulator;
    params.drive.initial_rest_s = 4.0;
    params.drive.initial_straight_m = 16.0;
    params.drive.distance_m = 1.0;
    params.drive.final_rest_s = 1.0;
    BagWriter writer(bag_.path(), config_);
    NeverStop never;
    simulateDrive(params, Planet::byName(config_.planet), never,
                  [&writer](const sim::Measurements& measurements, const sim::TruthState& truth) {
                    writer.write(measurements, truth);
                  });
    writer.close();
  }

  /// What an undisturbed run says, by stamp.
  std::map<Nanoseconds, Vector3> undisturbedPositions() const {
    std::map<Nanoseconds, Vector3> positions;
    for (const EstimateSample& sample : evaluateBag(bag_.path(), config_, "", {}).report.estimates) {
      positions[sample.stamp] = sample.position_enu_m;
    }
    return positions;
  }

  ros::NodeHandle node_;
  Config config_ = configFromParameters(node_, "slipnav");
  test::TemporaryBag bag_;
  std::vector<Arrival> arrivals_;
  ros::Subscriber listener_;
};

TEST_F(KillManager, TheEstimateGoesOnFromTheCheckpoint) {
  writeDrive();
  const std::map<Nanoseconds, Vector3> undisturbed = undisturbedPositions();
  ReplaySession session(config_.topics);
  session.waitForNodelets();
  const pid_t manager = pidOf("/slipnav_manager");
  ASSERT_GT(manager, 0);
  ros::SteadyTime killed;
  std::thread killer([&killed, manager] {
    ros::WallDuration(kKillAfter_s / kDriveRate).sleep();
    kill(manager, SIGKILL);
    killed = ros::SteadyTime::now();
  });
  session.play({bag_.path(), kDriveRate, 0.0, 0.0});
  killer.join();

  const auto resumed = std::find_if(arrivals_.begin(), arrivals_.end(),
                                    [&killed](const Arrival& arrival) { return arrival.time > killed; });
  ASSERT_NE(resumed, arrivals_.begin()) << "there was no estimate before";
  ASSERT_NE(resumed, arrivals_.end()) << "the estimate did not go on";
  const nav_msgs::Odometry& before = *std::prev(resumed)->message;
  EXPECT_LT((resumed->time - killed).toSec(), kNoticed_s + kLongestRestart_s);

  const double unwatched_s = (resumed->message->header.stamp - before.header.stamp).toSec();
  for (auto arrival = resumed; arrival != arrivals_.end(); ++arrival) {
    const nav_msgs::Odometry& estimate = *arrival->message;
    const geometry_msgs::Point& p = estimate.pose.pose.position;
    const auto truth = undisturbed.find(static_cast<Nanoseconds>(estimate.header.stamp.toNSec()));
    ASSERT_NE(truth, undisturbed.end());
    const Vector3 error = Vector3(p.x, p.y, p.z) - truth->second;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_LT(std::abs(error[static_cast<Eigen::Index>(axis)]), 3.0 * std::sqrt(estimate.pose.covariance[7 * axis]));
    }
    EXPECT_LT(error.norm(), kFastest_mps * (unwatched_s + config_.checkpoint.interval_s) + 1.0);
  }
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "kill_manager");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
