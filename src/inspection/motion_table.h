#pragma once
/// Measurements of wheels and IMU at the same moments, side by side.

#include <optional>
#include <vector>

#include "inspection/imu_track.h"
#include "inspection/rest.h"
#include "inspection/wheel_track.h"

namespace slipnav {

/// Of longer recordings only the beginning is examined [s].
inline constexpr double kLongestDrive_s = 86400.0;

/// Means over a window of 0.6 s, in the sensor's own axes.
struct MotionRow {
  double time_s = 0.0;
  std::size_t batch = 0;            ///< a few seconds each; errors of one batch belong together
  double speed = 0.0;               ///< by wheels
  double acceleration = 0.0;        ///< by wheels
  double turn = 0.0;                ///< by wheels, see WheelRow
  Vector3 force = Vector3::Zero();  ///< without gravity, which is propagated by the gyros from the start of the batch
  Vector3 rate = Vector3::Zero();   ///< without the bias at rest
};

/// Rows while wheels and IMU both have samples; acceleration and force have no mean over a batch.
struct MotionTable {
  std::vector<MotionRow> rows;
};

/// @param wheels_ahead_s by how much the stamps of the wheels are ahead of those of the IMU
MotionTable motionTable(const ImuTrack& imu, const WheelTrack& wheels, const RestPicture& rest, double wheels_ahead_s);

/// A quantity of a track by linear interpolation; nothing outside and in gaps.
class WheelInterpolation {
 public:
  explicit WheelInterpolation(const WheelTrack& wheels) : wheels_(wheels) {}
  std::optional<WheelRow> at(double time_s) const;

 private:
  const WheelTrack& wheels_;
};

}  // namespace slipnav
