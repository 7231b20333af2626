#include "slipnav/core/base/rotation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/random.h"

namespace slipnav {
namespace {

Vector3 roundTrip(const Vector3& phi) { return rotationVectorFromQuaternion(quaternionFromRotationVector(phi)); }

TEST(Rotation, SkewIsTheCrossProduct) {
  const Vector3 a(1.0, -2.0, 3.0);
  const Vector3 b(0.5, 4.0, -1.0);
  EXPECT_EQ(skew(a) * b, a.cross(b));
}

TEST(Rotation, QuaternionOfARotationVectorIsThatOfAngleAndAxis) {
  sim::RandomStream random(1, "rotation");
  for (const double angle : {0.0, 1e-12, 1e-6, 0.99e-4, 1.01e-4, 0.1, 1.0, 3.0, 3.14159265, 6.0}) {
    const Vector3 axis = random.normal3().normalized();
    const Quaternion expected(Eigen::AngleAxisd(angle, axis));
    const Quaternion q = quaternionFromRotationVector(angle * axis);
    EXPECT_NEAR((q.coeffs() - expected.coeffs()).norm(), 0.0, 1e-15) << angle;
    EXPECT_NEAR(q.norm(), 1.0, 1e-15);
  }
}

TEST(Rotation, RoundTripOfRotationVectors) {
  sim::RandomStream random(2, "rotation");
  EXPECT_EQ(roundTrip(Vector3::Zero()), Vector3::Zero());
  for (const double angle : {1e-14, 1e-9, 1e-6, 1e-4, 0.01, 0.5, 2.0, 3.0, kPi - 1e-6, kPi - 1e-9}) {
    for (int i = 0; i < 10; ++i) {
      const Vector3 phi = angle * random.normal3().normalized();
      EXPECT_NEAR((roundTrip(phi) - phi).norm(), 0.0, 1e-15 + 4e-16 * angle) << angle;
    }
  }
}

TEST(Rotation, VectorOfAQuaternionIgnoresItsSign) {
  const Vector3 phi(0.3, -0.2, 0.9);
  Quaternion q = quaternionFromRotationVector(phi);
  q.coeffs() *= -1.0;
  EXPECT_NEAR((rotationVectorFromQuaternion(q) - phi).norm(), 0.0, 1e-15);
  for (const double angle : {1e-9, 1e-7, 1e-3}) {
    Quaternion small = quaternionFromRotationVector(Vector3(0.0, angle, 0.0));
    small.coeffs() *= -1.0;
    EXPECT_NEAR(rotationVectorFromQuaternion(small).y() / angle, 1.0, 1e-9) << angle;
  }
  // beyond π it is the short way round
  EXPECT_NEAR((roundTrip(Vector3(0.0, 0.0, kPi + 0.1)) - Vector3(0.0, 0.0, -kPi + 0.1)).norm(), 0.0, 1e-14);
}

TEST(Rotation, EulerAnglesHaveTheSignsOfAVehicle) {
  const Vector3 forward = Vector3::UnitX();
  const Vector3 right = Vector3::UnitY();
  // yaw turns the nose from north to east, pitch lifts it (down is positive), roll lowers the right side
  EXPECT_NEAR((q_b_to_n_fromEuler(0.0, 0.0, 0.5 * kPi) * forward - Vector3(0.0, 1.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((q_b_to_n_fromEuler(0.0, 0.1, 0.0) * forward).z(), -std::sin(0.1), 1e-15);
  EXPECT_NEAR((q_b_to_n_fromEuler(0.1, 0.0, 0.0) * right).z(), std::sin(0.1), 1e-15);
  // order: yaw, then pitch, then roll: at 90° of yaw, pitch still lifts the nose
  EXPECT_NEAR((q_b_to_n_fromEuler(0.0, 0.2, 0.5 * kPi) * forward - Vector3(0.0, std::cos(0.2), -std::sin(0.2))).norm(),
              0.0, 1e-15);
}

TEST(Rotation, EulerRoundTrip) {
  sim::RandomStream random(3, "rotation");
  for (int i = 0; i < 100; ++i) {
    const Vector3 euler(random.uniform(-kPi, kPi), random.uniform(-1.55, 1.55), random.uniform(-kPi, kPi));
    const Vector3 back = eulerFrom_q_b_to_n(q_b_to_n_fromEuler(euler.x(), euler.y(), euler.z()));
    EXPECT_NEAR((back - euler).norm(), 0.0, 1e-12) << euler.transpose();
  }
  const Vector3 upright = eulerFrom_q_b_to_n(q_b_to_n_fromEuler(0.0, 0.5 * kPi, 0.0));
  EXPECT_NEAR(upright.y(), 0.5 * kPi, 1e-7);
  EXPECT_TRUE(upright.allFinite());
}

TEST(Rotation, WrapsIntoTheHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrapToPi(0.5), 0.5);
  EXPECT_NEAR(wrapToPi(2.0 * kPi + 0.5), 0.5, 1e-15);
  EXPECT_NEAR(wrapToPi(-7.0 * kPi + 0.25), -kPi + 0.25, 1e-14);
  EXPECT_DOUBLE_EQ(wrapToPi(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrapToPi(-kPi), kPi);
}

}  // namespace
}  // namespace slipnav
