#pragma once
/// Recordings as samples in core units and axes.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "evaluation/truth_track.h"
#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/models/gnss_fix.h"

namespace slipnav {

/// Receives each kind of message. Unusable ones go to `problem`: what is wrong in one line, and when
/// the message was recorded.
struct BagSink {
  std::function<void(const ImuSample&)> imu;
  std::function<void(const WheelMotion&)> wheels;
  std::function<void(const GnssFix&)> fix;
  std::function<void(const VelocityFix&)> velocity;
  /// For `initialization.source: truth` only: the first truth as the state of the IMU, and whether it has an attitude.
  std::function<void(const NavigationState&, bool)> truth_start;
  std::function<void(const GnssFix&)> truth_fix;
  std::function<void(const TruthSample&)> truth_pose;
  std::function<void(const std::string&, Nanoseconds)> problem;
};

/// Part of a recording, measured as by rosbag play.
struct BagRange {
  double start_s = 0.0;     ///< from the beginning
  double duration_s = 0.0;  ///< 0: up to the end
};

/// All errors are std::invalid_argument with one line that names the file: missing, damaged, not indexed, without
/// messages, or without a required topic.
class BagReader {
 public:
  /// @param truth topic of the truth; "" for the first of truth/fix, truth/odometry, truth/pose that the bag has
  BagReader(const std::string& path, const Config& config, const std::string& truth = "", const BagRange& range = {});
  /// @param paths the parts of one recording; errors name the first
  BagReader(const std::vector<std::string>& paths, const Config& config, const std::string& truth,
            const BagRange& range);
  ~BagReader();
  BagReader(BagReader&&) noexcept;
  BagReader& operator=(BagReader&&) noexcept;

  /// The configuration; with `extrinsics: tf`, with the poses from the bag's /tf_static.
  const Config& config() const;
  /// Whether the truth is a fix by latitude and longitude (and not a pose in its own frame), or there is none.
  bool truthIsGeodetic() const;
  /// When the first message read was recorded.
  Nanoseconds begin() const;
  /// Time from the first to the last message read [s].
  double duration() const;

  /// Passes on all messages in recording order.
  void read(const BagSink& sink) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipnav
