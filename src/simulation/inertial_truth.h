#pragma once
/// The error-free output of an IMU: mean angular rate and mean specific force over an interval, from the true motion.

#include "simulation/rover_motion.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav::sim {

/// Both means in body axes.
struct InertialMean {
  Vector3 f_ib_b = Vector3::Zero();
  Vector3 omega_ib_b = Vector3::Zero();
};

/// Averages over fine steps in the tangent plane, which rotates with the planet:
/// f = Cᵀ (dv/dt + 2 ω_ie × v − g) at the sensor, ω_ib = ω_eb + Cᵀ ω_ie.
class InertialTruth {
 public:
  /// @param lever_b sensor seen from base_link, body axes [m]
  InertialTruth(const Planet& planet, const LocalFrame& frame, const Vector3& lever_b, const Kinematics& start);

  /// Adds the fine step from the last state to this one.
  void add(const Kinematics& state, double dt_s);
  /// The means over all steps added since the last call.
  InertialMean finish();
  /// Values at the end of the last fine step, for a sensor that samples instantaneously.
  const InertialMean& instant() const { return instant_; }

  /// Rotation of the planet in the tangent plane's axes [rad/s].
  const Vector3& omega_ie_enu() const { return omega_ie_enu_; }

 private:
  Vector3 sensorVelocity(const Kinematics& state) const;
  Vector3 gravityAt(const Kinematics& state) const;

  Planet planet_;
  LocalFrame frame_;
  Vector3 lever_b_;
  Vector3 omega_ie_enu_;
  Kinematics last_;
  Vector3 last_gravity_enu_;
  Vector3 acceleration_sum_b_ = Vector3::Zero();            ///< ∫ Cᵀ (dv/dt + 2 ω_ie × v) dt
  Vector3 rate_sum_b_ = Vector3::Zero();                    ///< ∫ ω_ib dt
  Matrix3 rotation_sum_ = Matrix3::Zero();                  ///< ∫ C dt
  Vector3 angular_acceleration_b_ = Vector3::Zero();        ///< in the last step [rad/s²]
  Vector3 start_angular_acceleration_b_ = Vector3::Zero();  ///< at the start of the interval [rad/s²]
  InertialMean instant_;
  double last_dt_s_ = 0.0;
  double time_s_ = 0.0;
};

}  // namespace slipnav::sim
