#include "core/sensors/imu_mount.h"

#include "slipnav/core/base/rotation.h"

namespace slipnav {

void MountParams::visit(ParameterVisitor& v) {
  v.number("x_m", x_m, {-100.0, 100.0}, "ahead of base_link [m]");
  v.number("y_m", y_m, {-100.0, 100.0}, "left of base_link [m]");
  v.number("z_m", z_m, {-100.0, 100.0}, "above base_link [m]");
  v.number("roll_deg", roll_deg, {-360.0, 360.0}, "URDF roll of the sensor's axes in base_link [°]");
  v.number("pitch_deg", pitch_deg, {-360.0, 360.0}, "URDF pitch [°]");
  v.number("yaw_deg", yaw_deg, {-360.0, 360.0}, "URDF yaw [°]");
}

ImuMount::ImuMount(const MountParams& params) {
  // URDF's fixed-axis angles are the same product as yaw-pitch-roll.
  const Quaternion q_sensor_to_flu =
      q_b_to_n_fromEuler(degToRad(params.roll_deg), degToRad(params.pitch_deg), degToRad(params.yaw_deg));
  C_sensor_to_b_ = Vector3(1.0, -1.0, -1.0).asDiagonal() * q_sensor_to_flu.toRotationMatrix();
}

ImuSample ImuMount::toBody(Nanoseconds stamp, const Vector3& specific_force, const Vector3& angular_rate) const {
  return {stamp, C_sensor_to_b_ * specific_force, C_sensor_to_b_ * angular_rate};
}

}  // namespace slipnav
