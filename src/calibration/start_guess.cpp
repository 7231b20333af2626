#include "calibration/start_guess.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/ins/leveling.h"
#include "evaluation/alignment.h"
#include "evaluation/planar_dead_reckoning.h"
#include "evaluation/truth_lag.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav {
namespace {

/// Forward speed of the wheels at a stamp: that of the first sample which ends there or later.
double speedAt(const CalibrationDrive& drive, Nanoseconds stamp) {
  const auto wheels = std::lower_bound(drive.wheels.begin(), drive.wheels.end(), stamp,
                                       [](const WheelMotion& w, Nanoseconds t) { return w.stamp < t; });
  return wheels == drive.wheels.end() ? drive.wheels.back().motion.forward_mps : wheels->motion.forward_mps;
}

/// Roll and pitch at a stamp, over the window that follows it.
Vector2 level(const Config& config, const CalibrationDrive& drive, Nanoseconds stamp) {
  const Nanoseconds end = stamp + fromSeconds(config.initialization.leveling_window_s);
  std::vector<ImuSample> window;
  for (const ImuSample& sample : drive.imu) {
    if (sample.stamp >= stamp && sample.stamp <= end) {
      window.push_back(sample);
    }
  }
  if (window.size() < 2) {
    throw std::invalid_argument("there are not enough IMU samples to level by");
  }
  return levelAtRest(
      reactionToGravityOnTheMove(window, speedAt(drive, window.front().stamp), speedAt(drive, window.back().stamp)));
}

/// Dead reckoning by wheels and gyro from heading north.
PlanarTrack deadReckon(const CalibrationDrive& drive, Nanoseconds start) {
  PlanarDeadReckoning planar;
  planar.start({start, 0.0, 0.0, 0.0});
  for (const ImuSample& sample : drive.imu) {
    planar.addImu(sample);
  }
  for (const WheelMotion& wheels : drive.wheels) {
    planar.addSpeed({wheels.stamp, wheels.motion.forward_mps});
  }
  return planar.track();
}

EstimateTrack toEstimates(const PlanarTrack& planar) {
  EstimateTrack track;
  for (const PlanarSample& sample : planar) {
    EstimateSample estimate;
    estimate.stamp = sample.stamp;
    estimate.position_enu_m << sample.east_m, sample.north_m, 0.0;
    track.push_back(estimate);
  }
  return track;
}

TruthTrack truthOf(const Planet& planet, const CalibrationDrive& drive) {
  const LocalFrame frame(planet, drive.truth.front().position);
  std::vector<TruthSample> samples;
  for (const PositionFix& fix : drive.truth) {
    TruthSample sample;
    sample.stamp = fix.stamp;
    sample.position_enu_m = frame.toEnu(fix.position);
    samples.push_back(sample);
  }
  return TruthTrack(std::move(samples));
}

/// Heading of the truth relative to dead reckoning that starts northwards.
double heading(const Planet& planet, const Config& config, const CalibrationDrive& drive, Nanoseconds start) {
  const TruthTrack truth = truthOf(planet, drive);
  const PlanarTrack planar = deadReckon(drive, start);
  if (const std::optional<TruthLag> lag = truthLag(planar, truth)) {
    throw std::invalid_argument("truth is " + describe(*lag));
  }
  return headingOffset(truth, toEstimates(planar), config.initialization.drive_distance_m);
}

}  // namespace

NavigationState guessStart(const Planet& planet, const Config& config, const CalibrationDrive& drive,
                           const std::vector<TimedInterval>& intervals) {
  if (drive.truth.empty()) {
    throw std::invalid_argument("there are no truth positions");
  }
  const Nanoseconds first_fix = drive.truth.front().stamp;
  const auto interval = std::find_if(intervals.begin(), intervals.end(),
                                     [first_fix](const TimedInterval& i) { return i.end >= first_fix; });
  if (interval == intervals.end() || drive.truth.back().stamp <= interval->start) {
    throw std::invalid_argument("truth positions and IMU samples have no time in common");
  }
  if (drive.wheels.empty()) {
    throw std::invalid_argument("there are no usable wheel samples");
  }
  NavigationState state;
  state.stamp = interval->start;
  const Vector2 tilt_rad = level(config, drive, state.stamp);
  const double heading_rad = heading(planet, config, drive, state.stamp);
  state.q_b_to_n = q_b_to_n_fromEuler(tilt_rad.x(), tilt_rad.y(), heading_rad);
  state.v_eb_n = state.q_b_to_n * Vector3(speedAt(drive, state.stamp), 0.0, 0.0);
  state.position = drive.truth.front().position;
  ErrorVector lever = ErrorVector::Zero();
  lever.segment<3>(kPosition) = state.q_b_to_n * (config.truth_mount.position_b() - config.imu.mount.position_b());
  subtractError(planet, lever, state);
  return state;
}

}  // namespace slipnav
