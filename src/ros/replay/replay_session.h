#pragma once
/// One recording played through the running nodelets, and their result.

#include <ros/ros.h>

#include <functional>
#include <string>
#include <vector>

#include "config/topics.h"
#include "ros/bag/odometry_log.h"
#include "ros/replay/estimate_recorder.h"

namespace slipnav {

/// Which part of a recording is played, and how fast.
struct ReplayOptions {
  std::string bag;
  double rate = 1.0;        ///< factor on real time
  double start_s = 0.0;     ///< from the beginning of the recording
  double duration_s = 0.0;  ///< 0: up to its end
};

/// Subscribes, plays, and collects the estimates.
class ReplaySession {
 public:
  /// What to subscribe to, relative to the node's namespace. With odometry only,
  /// recorder() has none of the rest.
  enum class Outputs { kAll, kOdometry };

  explicit ReplaySession(const TopicNames& topics, Outputs outputs = Outputs::kAll);

  /// Waits until all nodelets are there and connected. Throws std::runtime_error that says what is missing.
  void waitForNodelets();

  /// Plays with rosbag play, with its clock, all topics that have subscribers, less those that the nodelets publish
  /// themselves, commands and moving transforms, until the estimate of `last_stamp`
  /// has arrived: the player is kept alive until then, since its queues would end with it. No message is lost: playing
  /// starts once everybody is connected, and queues hold whatever comes. A minute without an estimate also ends it,
  /// once the clock stands still or has passed the end of the recording. Throws std::runtime_error if rosbag play fails
  /// or ROS shuts down.
  void play(const ReplayOptions& options, Nanoseconds last_stamp);

  /// The same until `done`, which is asked after each batch of messages.
  void play(const ReplayOptions& options, const std::function<bool()>& done);

  const EstimateRecorder& recorder() const { return recorder_; }
  const OdometryLog& odometry() const { return odometry_; }

 private:
  /// Stamp of the newest complete estimate.
  Nanoseconds newestStamp() const {
    return outputs_ == Outputs::kOdometry ? odometry_.newestStamp() : recorder_.newestStamp();
  }

  ros::NodeHandle node_;
  TopicNames topics_;
  Outputs outputs_;
  EstimateRecorder recorder_;
  OdometryLog odometry_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace slipnav
