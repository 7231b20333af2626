/// The manager is killed while the rover drives: roslaunch starts it again, and the estimate resumes from the
/// checkpoint.

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nodelet/NodeletList.h>
#include <ros/ros.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/navigation/checkpoint.h"
#include "ros/bag/bag_evaluation.h"
#include "ros/replay/node_process.h"
#include "ros/replay/replay_session.h"
#include "ros/runtime/parameters.h"
#include "ros/simulated_bag.h"

namespace slipnav {
namespace {

constexpr double kDriveRate = 1.0;
constexpr double kKillAfter_s = 4.0;       // from the first estimate: the rover is driving
constexpr double kLongestRestart_s = 2.0;  // from the nodelets' restart to the first estimate
constexpr double kLongestStep_s = 1.0;     // between estimates of a manager that lives
constexpr double kFastest_mps = 0.8;
const ros::WallDuration kPollInterval(0.05);
const char* const kNodelets[] = {"/ins", "/filter", "/initializer"};

/// Whether the manager has all the nodelets that the estimate needs. Their loaders see only after some seconds without
/// a heartbeat that it was gone.
bool nodeletsLoaded() {
  nodelet::NodeletList list;
  if (!ros::service::call("slipnav_manager/list", list)) {
    return false;
  }
  const std::vector<std::string>& names = list.response.nodelets;
  return std::all_of(std::begin(kNodelets), std::end(kNodelets),
                     [&names](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); });
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
          const double estimated_s = (message->header.stamp - arrivals_.front().message->header.stamp).toSec();
          if (manager_ > 0 && !killed_ && estimated_s >= kKillAfter_s) {
            killed_ = kill(manager_, SIGKILL) == 0;
          }
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
  pid_t manager_ = 0;
  std::atomic<bool> killed_ = false;
  ros::Subscriber listener_;
};

TEST_F(KillManager, TheEstimateGoesOnFromTheCheckpoint) {
  writeDrive();
  const std::map<Nanoseconds, Vector3> undisturbed = undisturbedPositions();
  ReplaySession session(config_.topics);
  session.waitForNodelets();
  manager_ = pidOf("/slipnav_manager");
  ASSERT_GT(manager_, 0);
  std::atomic<bool> played = false;
  ros::SteadyTime restarted;
  std::thread watch([this, &played, &restarted] {
    while (!played && (!killed_ || !nodeletsLoaded())) {
      kPollInterval.sleep();
    }
    restarted = ros::SteadyTime::now();
  });
  session.play({bag_.path(), kDriveRate, 0.0, 0.0}, undisturbed.rbegin()->first);
  played = true;
  watch.join();

  ASSERT_TRUE(killed_) << "there was no estimate before";
  const auto before =
      std::adjacent_find(arrivals_.begin(), arrivals_.end(), [](const Arrival& arrival, const Arrival& next) {
        return (next.message->header.stamp - arrival.message->header.stamp).toSec() > kLongestStep_s;
      });
  ASSERT_NE(before, arrivals_.end()) << "the estimate did not go on";
  const auto resumed = std::next(before);
  EXPECT_LT((resumed->time - restarted).toSec(), kLongestRestart_s);

  const double unwatched_s = (resumed->message->header.stamp - before->message->header.stamp).toSec();
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
