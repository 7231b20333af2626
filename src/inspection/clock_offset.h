#pragma once
/// Whether the clocks of wheels and IMU agree, by the motion both observe.

#include "inspection/motion_table.h"

namespace slipnav {

/// By correlation over shifts of half a minute either way.
struct ClockOffset {
  bool known = false;           ///< one shift fits clearly better than all others
  double wheels_ahead_s = 0.0;  ///< stamps of the wheels less those of the IMU, for the same motion
  double std_s = 0.05;          ///< 1σ of it
  double correlation = 0.0;
  bool by_turns = false;  ///< heading rates; else accelerations

  /// Whether it is known, and clearly another one than `offset_s`.
  bool isBeyond(double offset_s) const;
};

/// @param up direction of the mean specific force in the sensor's axes
ClockOffset correlateClocks(const ImuTrack& imu, const WheelTrack& wheels, const Vector3& up);

}  // namespace slipnav
