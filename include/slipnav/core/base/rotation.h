#pragma once
/// Rotation vectors, skew matrices and Euler angles.

#include "slipnav/core/base/types.h"

namespace slipnav {

/// The matrix [a×] with [a×] b = a × b.
inline Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// Unit quaternion of the rotation by |phi| about phi; exact for any angle, smooth at zero.
Quaternion quaternionFromRotationVector(const Vector3& phi_rad);

/// Inverse of quaternionFromRotationVector(), angle in [0, π].
Vector3 rotationVectorFromQuaternion(const Quaternion& q);

/// Attitude of b in n from roll, pitch, yaw [rad]: yaw about z, then pitch about y, then roll about x (Groves 2.22).
Quaternion q_b_to_n_fromEuler(double roll_rad, double pitch_rad, double yaw_rad);

/// Roll, pitch, yaw [rad] of an attitude b in n (Groves 2.23); pitch in [−π/2, π/2].
Vector3 eulerFrom_q_b_to_n(const Quaternion& q_b_to_n);

/// Angle wrapped to (−π, π].
double wrapToPi(double angle_rad);

}  // namespace slipnav
