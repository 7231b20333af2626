#pragma once
/// Where the vehicle stands still, and its IMU readings there and while driving.

#include <vector>

#include "inspection/finding.h"
#include "inspection/imu_track.h"
#include "inspection/wheel_track.h"

namespace slipnav {

/// A time without motion of the wheels [s].
struct StillTime {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// Rests of the wheels of a second and more, without half a second at either end.
std::vector<StillTime> restsOf(const WheelTrack& wheels);

/// Means and deviations in the sensor's own axes.
struct RestPicture {
  std::vector<StillTime> rests;
  bool known = false;                   ///< there is a rest with samples in it
  Vector3 force = Vector3::Zero();      ///< mean at rest; over everything if there is no rest
  Vector3 rate = Vector3::Zero();       ///< at rest: the gyro bias; zero if there is no rest
  Vector3 force_std = Vector3::Zero();  ///< at rest, within each rest
  Vector3 rate_std = Vector3::Zero();
  Vector3 driving_force_std = Vector3::Zero();  ///< from sample to sample, while driving
  Vector3 driving_rate_std = Vector3::Zero();
};

/// @param rests of the wheels; those in which the gyros turn are excluded
RestPicture pictureOf(const ImuTrack& imu, const std::vector<StillTime>& rests);

/// Lower bound on the sensor's bias, from its readings at rest; 0 if unknown.
struct LeastBias {
  double force_mps2 = 0.0;  ///< magnitude of the specific force less gravity, if more than gravity varies
  double rate_radps = 0.0;
};

LeastBias leastBias(const RestPicture& picture);

void checkRests(const std::string& topic, const RestPicture& picture, Findings& findings);

}  // namespace slipnav
