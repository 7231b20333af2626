#pragma once
/// Dead reckoning from wheels and gyro next to the estimate, from its start on.

#include <deque>
#include <optional>

#include "evaluation/planar_dead_reckoning.h"

namespace slipnav {

/// The start becomes known after the fact: samples of the last minute are held back until then, earlier ones
/// are used for the gyro bias. The track is that of PlanarDeadReckoning fed with everything.
class WheelPath {
 public:
  void clear();
  /// Where the estimate starts. Later calls have no effect until clear().
  void start(const PlanarSample& pose);
  /// Samples that are not finite are dropped; stamps that go back by a second or more restart it, without a start.
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
