#pragma once
/// The white noise of a sensor, from its samples at rest.

#include <vector>

#include "inspection/imu_track.h"

namespace slipnav {

/// A time without motion of the wheels [s].
struct StillTime {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// Random walk of velocity and angle, per axis: the square roots of the densities.
struct RestNoise {
  bool known = false;
  double force = 0.0;  ///< [m/s/√s]
  double rate = 0.0;   ///< [rad/√s]
};

/// From third differences of means over 0.1, 0.2 and 0.4 s, as in ImuNoiseMeter: bias, tilt and slow sway cancel out.
/// Means, not samples: the output of many sensors is low-passed, and neighboring samples then differ by much less than
/// white noise of the same random walk would make them. White noise is the same at all lengths, and whatever shakes the
/// sensor adds to some: the least counts, and the median of the axes.
RestNoise restNoise(const ImuTrack& imu, const std::vector<StillTime>& rests);

}  // namespace slipnav
