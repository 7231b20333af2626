#pragma once
/// Everything an overlay shows of a drive, collected from nodelets and sensors.

#include <cstdint>
#include <deque>
#include <optional>

#include "config/overlay_params.h"
#include "overlay/shapes.h"
#include "overlay/stop_log.h"
#include "overlay/thinned_track.h"
#include "overlay/truth_follower.h"
#include "overlay/wheel_path.h"

namespace slipnav {

/// One point of a path as drawn, in the map frame.
struct TrackPoint {
  Nanoseconds stamp = 0;
  Vector3 position_enu_m = Vector3::Zero();
  Quaternion q_flu_to_enu = Quaternion::Identity();
  std::optional<double> slip;
};

using DisplayTrack = ThinnedTrack<TrackPoint>;

/// A drive begins with start(); earlier estimates are dropped. When the stamps of the estimate go back by a second
/// or more, tracks and stops are cleared.
class DriveView {
 public:
  DriveView(const OverlayParams& params, const TruthParams& truth, const Vector3& truth_lever_flu_m);

  /// Discards the drive and waits for the next start().
  void clear();
  /// @param frame the map frame; @param stamp the epoch at which estimates begin
  void start(const LocalFrame& frame, Nanoseconds stamp);

  /// @param estimate slip and stationary are ignored, see addSlip()
  void add(const EstimateSample& estimate);
  /// Once per wheel interval.
  void addSlip(Nanoseconds stamp, std::optional<double> slip, bool stationary);
  TruthFollower& truthInput() { return truth_follower_; }
  WheelPath& wheelInput() { return wheel_path_; }

  const DisplayTrack& track() const { return track_; }
  const DisplayTrack& truth() const { return truth_; }
  const DisplayTrack& wheels() const { return wheels_; }
  const StopLog& stops() const { return stops_; }
  const CourseEstimate& course() const { return course_; }
  const std::optional<EstimateSample>& newest() const { return newest_; }
  /// The newest epoch that has a truth.
  const std::optional<TruthPair>& newestPair() const { return pair_; }
  std::optional<double> slip() const { return slip_; }
  bool isStationary() const { return stationary_; }
  double distance() const { return distance_m_; }       ///< along the estimate [m]
  double horizontalBound() const;                       ///< 3σ of the newest estimate [m], along its worst direction
  std::optional<double> horizontalError() const;        ///< against truth [m]
  std::uint64_t revision() const { return revision_; }  ///< grows whenever anything has changed

 private:
  void clearDrive();
  void takeWheelPath();
  void takeTruth(const EstimateSample& earlier, const EstimateSample& later);

  bool flat_;
  DisplayTrack track_;
  DisplayTrack truth_;
  DisplayTrack wheels_;
  StopLog stops_;
  TruthFollower truth_follower_;
  WheelPath wheel_path_;
  std::deque<PlanarSample> wheel_poses_;  ///< which the estimate has yet to reach
  CourseEstimate course_;
  std::optional<Nanoseconds> start_;
  std::optional<EstimateSample> newest_;
  std::optional<TruthPair> pair_;
  std::optional<double> slip_;
  bool stationary_ = false;
  double distance_m_ = 0.0;
  Vector3 distance_mark_enu_m_ = Vector3::Zero();
  std::uint64_t revision_ = 0;
};

}  // namespace slipnav
