#include "slipnav/core/base/rotation.h"

#include <algorithm>
#include <cmath>

namespace slipnav {

Quaternion quaternionFromRotationVector(const Vector3& phi_rad) {
  const double angle = phi_rad.norm();
  // sin(angle/2)/angle, by its series where the quotient loses digits
  const double half_sinc = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), half_sinc * phi_rad.x(), half_sinc * phi_rad.y(), half_sinc * phi_rad.z()};
}

Vector3 rotationVectorFromQuaternion(const Quaternion& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const Vector3 v = sign * q.vec();
  const double sine = v.norm();
  if (sine < 1e-8) {
    return 2.0 * v;
  }
  return v * (2.0 * std::atan2(sine, sign * q.w()) / sine);
}

Quaternion q_b_to_n_fromEuler(double roll_rad, double pitch_rad, double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vector3::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Vector3::UnitX());
}

Vector3 eulerFrom_q_b_to_n(const Quaternion& q_b_to_n) {
  const Matrix3 C_b_to_n = q_b_to_n.toRotationMatrix();
  return {std::atan2(C_b_to_n(2, 1), C_b_to_n(2, 2)), -std::asin(std::clamp(C_b_to_n(2, 0), -1.0, 1.0)),
          std::atan2(C_b_to_n(1, 0), C_b_to_n(0, 0))};
}

double wrapToPi(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

}  // namespace slipnav
