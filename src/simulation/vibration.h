#pragma once
/// Vibration of the body on rough ground that a block mean lets through: small, fast, and without drift.

#include "simulation/ground.h"
#include "simulation/inertial_truth.h"
#include "simulation/random.h"

namespace slipnav::sim {

/// At the end of each IMU interval the body is off its smooth motion by a random offset of micrometers, with the
/// corresponding velocity, and a random attitude, in proportion to the speed; some vibration remains at rest. The IMU
/// senses the changes. They are real motion and part of the truth.
class Vibration {
 public:
  /// @param factor on the ground's vibration
  /// @param rate_hz of the IMU, which the ground's figures refer to
  Vibration(const GroundParams& ground, double factor, double rate_hz, std::uint64_t seed);

  /// IMU reading in an interval instead of the smooth motion's mean.
  InertialMean shake(const InertialMean& smooth, double dt_s, double speed_mps);

  /// Velocity [m/s] and attitude [rad] of the body on top of the smooth motion at the end of the last interval, body
  /// axes.
  const Vector3& velocity() const { return velocity_b_; }
  const Vector3& angle() const { return angle_b_; }

 private:
  double offset_sigma_;  ///< at kVibrationSpeed_mps
  double tremor_sigma_;
  double angle_sigma_;
  RandomStream stream_;
  Vector3 offset_b_ = Vector3::Zero();
  Vector3 velocity_b_ = Vector3::Zero();
  Vector3 angle_b_ = Vector3::Zero();
};

}  // namespace slipnav::sim
