#pragma once
/// Where the vehicle stands still, and its IMU readings there and while driving.

#include <vector>

#include "inspection/finding.h"
#include "inspection/imu_track.h"
#include "inspection/rest_noise.h"
#include "inspection/wheel_track.h"
#include "slipnav/core/ekf/error_dynamics.h"

namespace slipnav {

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
  RestNoise noise;
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

/// imu.noise that the readings at rest exceed; 0 if they do not, or if they are not known.
struct LeastNoise {
  double accel_noise_mps_per_sqrt_h = 0.0;
  double gyro_noise_deg_per_sqrt_h = 0.0;
};

/// @param assumed what the sensor is believed to be
LeastNoise leastNoise(const RestPicture& picture, const ImuNoiseParams& assumed);

/// @param assumed imu.noise as configured
void checkRests(const std::string& topic, const RestPicture& picture, const ImuNoiseParams& assumed,
                Findings& findings);

}  // namespace slipnav
