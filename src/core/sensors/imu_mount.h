#pragma once
/// Sensor poses on the vehicle, as users give them (REP-103: x forward, y left, z up), and the conversion to body axes.

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Pose of a sensor in base_link; angles as in URDF: R = Rz(yaw) Ry(pitch) Rx(roll).
struct MountParams {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;
  void visit(ParameterVisitor& v);

  /// Position of the sensor in body axes, forward-right-down [m].
  Vector3 position_b() const { return {x_m, -y_m, -z_m}; }
};

/// Rotates a sample from the sensor's own axes into the body axes of the vehicle.
class ImuMount {
 public:
  explicit ImuMount(const MountParams& params);

  /// @param specific_force,angular_rate in the sensor's own axes [m/s²], [rad/s]
  ImuSample toBody(Nanoseconds stamp, const Vector3& specific_force, const Vector3& angular_rate) const;

  /// A body-axes vector in the sensor's own axes.
  Vector3 toSensor(const Vector3& v_b) const { return C_sensor_to_b_.transpose() * v_b; }

 private:
  Matrix3 C_sensor_to_b_;
};

}  // namespace slipnav
