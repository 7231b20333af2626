#pragma once
/// The baseline: two-dimensional dead reckoning by wheel speed and integrated gyro heading (the paper's "2D WIO").

#include <deque>
#include <optional>
#include <vector>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// Pose in the plane, in the map frame.
struct PlanarSample {
  Nanoseconds stamp = 0;
  double east_m = 0.0;
  double north_m = 0.0;
  double heading_rad = 0.0;  ///< from north, clockwise
};

using PlanarTrack = std::vector<PlanarSample>;

/// When the rover counts as standing at the start.
struct PlanarOptions {
  double standstill_speed_mps = 0.01;  ///< wheels slower than this stand still
  double min_standstill_s = 2.0;       ///< the gyro bias is taken from an initial standstill at least this long
};

/// Integrates the vertical body gyro to a heading and the wheel speed along it, on a plane, using nothing else
/// but the gyro's mean during the initial standstill of the wheels. Until the wheels first turn the heading is held.
///
/// Both inputs are means over the interval that ends at their stamp. Each is taken in order of stamp,
/// independently; a speed is used once the IMU has reached its stamp, so that their interleaving does not matter.
class PlanarDeadReckoning {
 public:
  explicit PlanarDeadReckoning(const PlanarOptions& options = {});

  /// Where the track starts. Samples up to its stamp are used only for the gyro bias. May be called after samples have
  /// arrived, but not twice: std::logic_error.
  void start(const PlanarSample& pose);

  /// @return false, and the sample is dropped, if it is not later than the previous one
  bool addImu(const ImuSample& imu);
  /// @return false, and the sample is dropped, if it is not later than the previous one
  bool addSpeed(const SpeedSample& speed);

  /// The start pose, then one sample per wheel epoch; empty before start().
  const PlanarTrack& track() const { return track_; }
  /// Returns the track and continues with its newest pose only, for callers that must not let it grow.
  PlanarTrack takeTrack();
  /// Mean of the vertical gyro over the initial standstill [rad/s]; zero if there was none long enough.
  double gyroBias() const;

 private:
  struct Turn {
    Nanoseconds begin;
    Nanoseconds end;
    double rate_radps;
  };

  void processReady();
  std::vector<Turn> takeTurnsUntil(Nanoseconds stamp);
  void collectBias(const std::vector<Turn>& turns);
  void integrate(const std::vector<Turn>& turns, const SpeedSample& speed);

  PlanarOptions options_;
  std::deque<Turn> turns_;
  std::deque<SpeedSample> speeds_;
  std::optional<Nanoseconds> last_imu_;
  std::optional<Nanoseconds> last_speed_;
  bool has_moved_ = false;
  double standstill_s_ = 0.0;
  double standstill_angle_rad_ = 0.0;
  PlanarTrack track_;
};

}  // namespace slipnav
