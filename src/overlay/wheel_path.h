#pragma once
/// Dead reckoning by wheels and gyro beside the estimate, from the moment on that the estimate begins.

#include <deque>
#include <optional>

#include "evaluation/planar_dead_reckoning.h"

namespace slipnav {

/// The start is found out after the fact: samples of the last minute are held back until it is known, earlier ones
/// serve the gyro bias. The track is that of PlanarDeadReckoning fed with everything.
class WheelPath {
 public:
  void clear();
  /// Where the estimate begins. Later calls have no effect until clear().
  void start(const PlanarSample& pose);
  /// Samples that are not finite are left out; stamps that go back by a second or more begin anew, without start.
  void add(const ImuSample& imu);
  void add(const SpeedSample& speed);

  bool started() const { return started_; }
  /// Poses since the last call, oldest first.
  PlanarTrack take();

 private:
  void release(Nanoseconds until);

  PlanarDeadReckoning reckoning_;
  std::deque<ImuSample> imu_;
  std::deque<SpeedSample> speeds_;
  bool started_ = false;
};

}  // namespace slipnav
