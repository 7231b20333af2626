/// `rover.launch` as it is, on a roscore where a simulation ran before. The manager is killed while the rover drives:
/// roslaunch restarts it, and the estimate resumes from the state that this launch has kept.

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
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
constexpr double kResumedFor_s = 10.0;     // from the first estimate after that
constexpr double kDriveLength_m = 60.0;    // enough for a busy machine; not played to its end
constexpr double kLongestSilence_s = 5.0;  // of real time, from the last estimate before to the first one after
constexpr double kLongestStep_s = 0.3;     // between stamps while the manager is alive
constexpr double kFastest_mps = 0.8;

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
          if (manager_ > 0 && !killed_ && estimated_s >= kKillAfter_s && hasCheckpoint()) {
            killed_ = kill(manager_, SIGKILL) == 0;
          }
        };
    listener_ = node_.subscribe<nav_msgs::Odometry>(config_.topics.odometry, 0, note);
  }

  ~KillManager() override { deleteCheckpoint(config_.checkpoint.place()); }

  /// A busy disk takes its time.
  bool hasCheckpoint() const { return loadCheckpoint(config_.checkpoint.place()).checkpoint.has_value(); }

  /// The last estimate before the manager was killed; the end if there is none after it.
  std::vector<Arrival>::const_iterator lastBefore() const {
    return std::adjacent_find(arrivals_.begin(), arrivals_.end(), [](const Arrival& arrival, const Arrival& next) {
      return stampsApart_s(arrival, next) > kLongestStep_s;
    });
  }

  static double stampsApart_s(const Arrival& from, const Arrival& to) {
    return (to.message->header.stamp - from.message->header.stamp).toSec();
  }

  bool hasResumed() const {
    const auto before = lastBefore();
    return before != arrivals_.end() && stampsApart_s(*std::next(before), arrivals_.back()) >= kResumedFor_s;
  }

  /// A short rest, then driving straight ahead all the time.
  void writeDrive() const {
    sim::SimulatorParams params = config_.simulator;
    params.drive.initial_rest_s = 4.0;
    params.drive.initial_straight_m = kDriveLength_m;
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
  bool killed_ = false;
  ros::Subscriber listener_;
};

TEST_F(KillManager, TheEstimateGoesOn) {
  ASSERT_TRUE(config_.checkpoint.file.empty()) << "nobody has asked for a checkpoint";
  writeDrive();
  const std::map<Nanoseconds, Vector3> undisturbed = undisturbedPositions();
  ReplaySession session(config_.topics);
  session.waitForNodelets();
  manager_ = pidOf("/slipnav_manager");
  ASSERT_GT(manager_, 0);
  session.play({bag_.path(), kDriveRate, 0.0, 0.0}, [this] { return hasResumed(); });

  ASSERT_TRUE(killed_) << "there was no estimate before";
  const auto before = lastBefore();
  ASSERT_NE(before, arrivals_.end()) << "the estimate did not go on";
  const auto resumed = std::next(before);
  const double silent_s = (resumed->time - before->time).toSec();
  RecordProperty("silent_s", std::to_string(silent_s));
  EXPECT_LT(silent_s, kLongestSilence_s);

  const double unwatched_s = stampsApart_s(*before, *resumed);
  for (auto arrival = resumed; arrival != arrivals_.cend(); ++arrival) {
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
